#pragma once
// Exact edge correspondences of rendered frames as text files, for whoever develops a matcher:
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

/// The edge pixels of an image as the camera took it, in the undistorted image.
using EdgePixelFinder = std::function<std::vector<Eigen::Vector2d>(const GrayImage&)>;

/// Frames begin <= index < end into `folder`/correspondences. `find_edges` is asked for the edges of each
/// frame but the last, in their order. Throws InputError for fewer than two frames, for a rolling shutter
/// (rows have poses of their own) and where something cannot be written. `on_pair_done` is told how many
/// pairs are done.
void export_correspondences(const SceneRenderer& renderer, const std::string& folder, int begin, int end,
                            const EdgePixelFinder& find_edges,
                            const std::function<void(int)>& on_pair_done = {});

}  // namespace edgevo
