// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The map of a run in 3D, to rotate, zoom and pick in a browser: points and lines of edges, the path of the
// camera, its keyframes and the true path. A script in the page (assets/map_view.js) draws it without a
// graphics card and without loading anything; one core rotates 300,000 vertices smoothly.
//
// All positions are in the map's frame (x forward, y left, z up; T_map_world), in `unit`.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// A vertex of the map: a point, or the start of a line through the `joined` vertices after it.
struct MapVertex {
  /// Position in the map's frame; finite.
  Eigen::Vector3f position = Eigen::Vector3f::Zero();
  /// Standard deviation of the position along the viewing ray; <= 0: unknown.
  float sigma = 0;
  /// Intensity in the image of its host, 0 to 255.
  uint8_t gray = 0;
  /// Whether a line connects the vertex to the one before.
  bool joined = false;
  /// Index of the host keyframe in MapView::keyframes; -1: none.
  int keyframe = -1;
};

/// A keyframe, drawn as a small camera.
struct MapKeyframe {
  /// Index of the frame in the source.
  int frame_index = 0;
  /// Pose of the camera (x right, y down, z forward) in the map's frame.
  SE3 T_map_cam;
};

/// Contents of the 3D view.
struct MapView {
  /// Unit of all lengths: "m" or "units".
  std::string unit;
  /// Points and lines. More than kMaxMapVertices are thinned evenly, and the page says so.
  std::vector<MapVertex> vertices;
  /// Keyframes in time order.
  std::vector<MapKeyframe> keyframes;
  /// Time of each frame since the first.
  std::vector<double> seconds;
  /// Estimated and true position of each frame; `truth` may be empty.
  std::vector<std::optional<Eigen::Vector3d>> path, truth;
};

/// Largest number of vertices in a page: 3.3 MB at 11 bytes each, drawn by one core of a laptop in 0.1 s.
constexpr size_t kMaxMapVertices = 300'000;

/// Edge points that `filter` keeps, keyframe by keyframe in the order of edges.ply, in the unit of the run.
std::vector<MapVertex> map_points(const Run& run, const PointFilter& filter);

/// Lines of the edge map, keyframe by keyframe, in the unit of the run.
std::vector<MapVertex> map_lines(const Run& run);

/// The view as HTML with its script, at most one a page. Empty if there are neither vertices nor a path.
std::string draw(const MapView& view);

}  // namespace edgevo
