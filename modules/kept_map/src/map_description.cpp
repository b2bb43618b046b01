// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "edgevo/core/formatted.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/kept_map/kept_map.h"

namespace edgevo {
namespace {

using Lines = std::vector<std::pair<std::string, std::string>>;

// What is summed over the keyframes.
struct MapCounts {
  size_t points = 0, edges = 0, edge_pixels = 0, corners = 0;
  std::set<std::pair<int, int>> epochs;
  std::set<int> segments;
  std::vector<double> means, contrasts;
  Eigen::AlignedBox3d path;
  double length = 0;
};

MapCounts count(const PlaceStore& store) {
  MapCounts n;
  const StoredKeyframe* before = nullptr;
  for (const StoredKeyframe& k : store.keyframes()) {
    n.points += k.record->points.size();
    n.edges += k.view->edges.begins.size(), n.edge_pixels += k.view->edges.at.size();
    n.corners += k.view->corners.px.size();
    n.epochs.insert({k.record->segment, k.epoch});
    n.segments.insert(k.record->segment);
    n.means.push_back(k.view->light.mean), n.contrasts.push_back(k.view->light.contrast);
    const Eigen::Vector3d& at = k.record->T_world_cam.translation();
    n.path.extend(at);
    if (before && before->epoch == k.epoch)
      n.length += (at - before->record->T_world_cam.translation()).norm();
    before = &k;
  }
  return n;
}

std::string range_of(std::vector<double> values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double low = *least, high = *most;
  return formatted("%.0f (%.0f to %.0f)", median(std::move(values)), low, high);
}

void describe_keyframes(const KeptMap& map, uintmax_t bytes, const MapCounts& n, Lines* lines) {
  const size_t keyframes = map.store.size();
  const double one = 1.0 / double(std::max<size_t>(keyframes, 1));
  lines->emplace_back("keyframes", formatted("%zu in %zu segments, %zu epochs", keyframes, n.segments.size(),
                                             n.epochs.size()));
  lines->emplace_back(
      "size", formatted("%.1f MB, %.1f kB a keyframe", double(bytes) / 1e6, double(bytes) / 1e3 * one));
  lines->emplace_back("points", formatted("%zu, %.0f a keyframe", n.points, double(n.points) * one));
  lines->emplace_back("edges",
                      formatted("%zu, %.0f pixels a keyframe", n.edges, double(n.edge_pixels) * one));
  lines->emplace_back("descriptors", formatted("%zu, %.0f a keyframe", n.corners, double(n.corners) * one));
}

// 0 if there is no such file.
uintmax_t size_of(const std::string& path) {
  std::error_code error;
  const uintmax_t size = std::filesystem::file_size(path, error);
  return error ? 0 : size;
}

std::string unit_of(const KeptMap& map) {
  if (!map.is_metric()) return "arbitrary (no scale was given)";
  return "metre (scale from " + map.scale_source + formatted(", +- %.1f %%)", 100 * map.scale_sigma);
}

std::string constraints_of(const KeptMap& map) {
  size_t motions = 0, places = 0;
  for (const StoredKeyframe& k : map.store.keyframes()) motions += k.next.has_value();
  for (const Constraint& c : map.constraints) places += c.kind == ConstraintKind::kPlace;
  return formatted("%zu motions to the next keyframe, %zu places seen again, %zu others", motions, places,
                   map.constraints.size() - places);
}

}  // namespace

std::string camera_text(const Camera& camera) {
  const Pinhole p = camera.pinhole();
  std::string text = formatted("%s, %d x %d, fx %.6g, fy %.6g, cx %.6g, cy %.6g px", to_string(camera.model),
                               p.width, p.height, p.fx, p.fy, p.cx, p.cy);
  for (const auto& [name, value] : coefficients_of(camera.model))
    text += formatted(", %s %.6g", name.c_str(), value);
  return text;
}

std::vector<std::pair<std::string, std::string>> describe(const KeptMap& map, const std::string& path) {
  const MapCounts n = count(map.store);
  const uintmax_t bytes = size_of(path) + size_of(path + "-wal");
  Lines lines{{"source", map.header.source}, {"state", map.is_finished ? "finished" : "interrupted"}};
  describe_keyframes(map, bytes, n, &lines);
  lines.emplace_back("constraints", constraints_of(map));
  lines.emplace_back("unit", unit_of(map));
  if (map.store.size() > 0) {
    const Eigen::Vector3d extent = n.path.sizes();
    lines.emplace_back("extent", formatted("path of %.4g in %.4g x %.4g, %.4g high", n.length, extent.x(),
                                           extent.z(), extent.y()));
    lines.emplace_back("mean gray level", range_of(n.means));
    lines.emplace_back("contrast", range_of(n.contrasts));
  }
  const Pinhole& p = map.header.pinhole;
  lines.emplace_back("camera", map.header.camera);
  lines.emplace_back("rectified to", formatted("%d x %d, fx %.6g, fy %.6g, cx %.6g, cy %.6g px", p.width,
                                               p.height, p.fx, p.fy, p.cx, p.cy));
  return lines;
}

}  // namespace edgevo
