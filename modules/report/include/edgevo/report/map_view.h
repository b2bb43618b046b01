#pragma once
// The map of a run in 3D, to be turned, zoomed and picked from in a browser: points and lines of edges, the
// way of the camera, its keyframes, the true way. It is drawn by a script in the page itself
// (assets/map_view.js), without a graphics card and without anything that is loaded: 300,000 vertices are
// turned fluidly by one core.
//
// All positions are in the map's frame (x forward, y left, z up; T_map_world), in `unit`.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// A point of the map; with those that follow it and are `joined`, a line.
struct MapVertex {
  Eigen::Vector3f position = Eigen::Vector3f::Zero();  ///< finite
  float sigma = 0;      ///< one standard deviation of the position, along the ray that saw it; <= 0: unknown
  uint8_t gray = 0;     ///< intensity in the image of its host
  bool joined = false;  ///< a line leads here from the vertex before
  int keyframe = -1;    ///< index of the host in MapView::keyframes; -1: none
};

/// A keyframe as a small camera.
struct MapKeyframe {
  int frame_index = 0;  ///< in the source
  SE3 T_map_cam;        ///< camera x right, y down, z forward
};

/// What the view shows.
struct MapView {
  std::string unit;                 ///< of all lengths: "m", "units"
  std::vector<MapVertex> vertices;  ///< more than kMostMapVertices are thinned evenly, and the page says so
  std::vector<MapKeyframe> keyframes;  ///< in time order
  std::vector<double> seconds;                              ///< of each frame, since the first
  std::vector<std::optional<Eigen::Vector3d>> path, truth;  ///< one for each frame; truth may be empty
};

/// What a page carries: 8 bytes each (11 as text), 3.3 MB, and what one core of a laptop draws in a tenth of
/// a second.
constexpr size_t kMostMapVertices = 300'000;

/// The edge points that `filter` keeps, keyframe after keyframe as edges.ply has them, in the unit of the
/// run.
std::vector<MapVertex> map_points(const Run& run, const PointFilter& filter);

/// The lines of the edge map, keyframe after keyframe, in the unit of the run.
std::vector<MapVertex> map_lines(const Run& run);

/// HTML with its script: one a page. A view without vertices and without a path gives nothing.
std::string draw(const MapView& view);

}  // namespace edgevo
