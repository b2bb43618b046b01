// SPDX-License-Identifier: BSD-3-Clause
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

/// Options of the scene.
struct SceneOptions {
  /// Largest number of points, for a fluent viewer; with more, every n-th point is shown.
  int max_points = 500'000;
};

/// Writes the scene. Throws InputError if the file cannot be written.
void write_scene(const Run& run, const PointFilter& filter, const std::string& path,
                 const SceneOptions& options = {});

}  // namespace edgevo
