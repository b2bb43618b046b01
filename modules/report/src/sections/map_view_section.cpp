// SPDX-License-Identifier: BSD-3-Clause
#include "map_view_section.h"

#include <algorithm>

#include "edgevo/report/page.h"
#include "frame_times.h"

namespace edgevo {
namespace {

std::vector<MapVertex> in_unit_of(const ShownPath& path, std::vector<MapVertex> vertices) {
  const float scale = float(path.metres_per_unit);
  for (MapVertex& v : vertices) v.position *= scale, v.sigma *= scale;
  return vertices;
}

std::vector<MapKeyframe> keyframes_of(const Run& run, const ShownPath& path) {
  const SE3 T_map = T_map_world(run);
  std::vector<MapKeyframe> keyframes;
  for (const KeyframeRecord& k : run.keyframes) {
    const SE3 T = T_map * k.T_world_cam;
    keyframes.push_back({k.frame_index, SE3(T.rotation(), path.metres_per_unit * T.translation())});
  }
  return keyframes;
}

bool has_any(const std::vector<std::optional<Eigen::Vector3d>>& path) {
  return std::any_of(path.begin(), path.end(), [](const auto& p) { return p.has_value(); });
}

}  // namespace

std::string map_view_section(const ReportInput& in, const ShownPath& path) {
  if (in.map_vertices.empty() && !has_any(path.estimate))
    return section_html("space", "Map in 3D", note_html("There is neither a path nor a point to show."));
  MapView view{path.unit,
               in_unit_of(path, in.map_vertices),
               keyframes_of(in.run, path),
               seconds_of(in.run),
               path.estimate,
               {}};
  if (has_any(path.truth)) view.truth = path.truth;
  return section_html("space", "Map in 3D", draw(view));
}

}  // namespace edgevo
