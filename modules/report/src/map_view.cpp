// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/report/map_view.h"

#include "assets.h"
#include "color_ramp.h"
#include "edgevo/report/page.h"
#include "map_packing.h"

namespace edgevo {
namespace {

// Standard deviation along the ray: relative uncertainty of the depth, times the distance. `p`: EdgePoint or
// EdgeVertex.
template <typename Seen>
float sigma_of(const Seen& p, const Eigen::Vector3d& p_cam) {
  return float(p_cam.norm() * double(p.idepth_sigma) / double(p.idepth));
}

void add_line(const EdgeLine& line, const Pinhole& pinhole, const SE3& T_map_cam, int keyframe,
              std::vector<MapVertex>* vertices) {
  bool joined = false;
  for (const EdgeVertex& v : line.vertices) {
    const Eigen::Vector3d p_cam = point_in_camera(pinhole, v);
    const auto gray = uint8_t((v.gray_dark + v.gray_bright) / 2);
    vertices->push_back({(T_map_cam * p_cam).cast<float>(), sigma_of(v, p_cam), gray, joined, keyframe});
    joined = true;
  }
}

std::string count_statement(size_t shown, size_t all) {
  const std::string count = std::to_string(shown) + (shown == 1 ? " vertex" : " vertices") + " of the map";
  return shown == all
             ? count + "."
             : count + ", taken evenly from " + std::to_string(all) + "; the run's edges.ply has all.";
}

std::string script_html(const char* script) { return "<script>" + std::string(script) + "</script>\n"; }

}  // namespace

std::vector<MapVertex> map_points(const Run& run, const PointFilter& filter) {
  std::vector<MapVertex> vertices;
  const SE3 T_map = T_map_world(run);
  for (size_t k = 0; k < run.keyframes.size(); ++k) {
    const SE3 T_map_cam = T_map * run.keyframes[k].T_world_cam;
    for (const EdgePoint& p : run.keyframes[k].points) {
      if (!filter.keeps(p)) continue;
      const Eigen::Vector3d p_cam = point_in_camera(run.pinhole, p);
      vertices.push_back({(T_map_cam * p_cam).cast<float>(), sigma_of(p, p_cam), p.gray, false, int(k)});
    }
  }
  return vertices;
}

std::vector<MapVertex> map_lines(const Run& run) {
  std::vector<MapVertex> vertices;
  const SE3 T_map = T_map_world(run);
  for (size_t k = 0; k < run.keyframes.size(); ++k)
    for (const EdgeLine& line : run.keyframes[k].lines)
      add_line(line, run.pinhole, T_map * run.keyframes[k].T_world_cam, int(k), &vertices);
  return vertices;
}

std::string draw(const MapView& all) {
  if (all.vertices.empty() && all.path.empty()) return "";
  MapView view = all;
  view.vertices = thinned(all.vertices, kMaxMapVertices);
  return "<div class=\"map3d\">\n" + std::string(assets::kMapViewHtml) +
         note_html(count_statement(view.vertices.size(), all.vertices.size())) +
         "<script type=\"application/json\">" + packed(view) + "</script>\n</div>\n" +
         script_html(assets::kMapDataJs) + script_html(assets::kMapDrawingJs) +
         script_html(assets::kMapViewJs);
}

}  // namespace edgevo
