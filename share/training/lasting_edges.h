// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Lasting edges: pixels of a keyframe that a run found again in several other keyframes, each in different
// light.
//
// An alternative label to true edges (simulation/true_edge_labels.h): edges of geometry and texture may not
// survive the next change of light, and odometry can use only those that do. A run under `mixed` light makes
// the edge map, keyframe by keyframe; a pixel lasts if at least EdgeMapParams::min_views other keyframes show
// an edge of like direction at its depth (edge_map/edge_depth.h).
#include <opencv2/core.hpp>
#include <vector>

#include "edgevo/simulation/scene.h"

namespace edgevo::training {

/// Frame of a scene with its label.
struct LabelledFrame {
  /// Index of the frame in the scene.
  int frame = 0;
  /// Label image, CV_8U, nonzero at edge pixels.
  cv::Mat label;
};

/// Labels of the keyframes of one run through the scene, in order of time. The light depends on the seed, and
/// the same seed gives the same labels. Lost frames have no edges. The camera must have no distortion. Cost:
/// about 0.1 s per frame.
std::vector<LabelledFrame> lasting_edges(const Scene& scene, uint64_t seed);

}  // namespace edgevo::training
