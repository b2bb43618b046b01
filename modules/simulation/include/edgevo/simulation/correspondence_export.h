// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Exact edge correspondences of rendered frames as text files, for developing matchers:
//
//   correspondences/000000.csv ..   x,y,x_next,y_next,visible: each edge pixel of the frame, and where it is
//                                   seen in the next one
//
// Sub-pixel positions in the undistorted images; empty fields where it is not in the next view. `visible` is
// 1 or 0. The last frame has no next one, hence no file.
#include <functional>
#include <string>
#include <vector>

#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {

/// Finds the edge pixels of an image as taken by the camera; positions are in the undistorted image.
using EdgePixelFinder = std::function<std::vector<Eigen::Vector2d>(const GrayImage&)>;

/// Writes frames begin <= index < end to `folder`/correspondences. `find_edges` is called for each frame but
/// the last, in order. `on_pair_done` receives the number of pairs done. Throws InputError for fewer than two
/// frames, for a rolling shutter (each row has its own pose) and when something cannot be written.
void export_correspondences(const SceneRenderer& renderer, const std::string& folder, int begin, int end,
                            const EdgePixelFinder& find_edges,
                            const std::function<void(int)>& on_pair_done = {});

}  // namespace edgevo
