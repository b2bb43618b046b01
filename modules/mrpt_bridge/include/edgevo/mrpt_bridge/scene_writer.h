#pragma once
// scene.3Dscene: trajectory, keyframes and coloured edges, for SceneViewer3D and robot-map-gui.
//
// World: T_map_world(run), z up; the origin, where the viewer starts, is the first pose. The trajectory is
// one line a segment, each in its colour, drawn through the frames that have a pose; keyframes are wire
// frusta; points are coloured by height, from the 5th percentile (blue) to the 95th (red). One grid on the
// ground plane shows the unit.
#include <string>

#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// What the scene shows.
struct SceneOptions {
  int max_points = 500'000;  ///< a viewer stays fluent; with more, every n-th point is shown
};

/// Throws InputError when the file cannot be written.
void write_scene(const Run& run, const PointFilter& filter, const std::string& path,
                 const SceneOptions& options = {});

}  // namespace edgevo
