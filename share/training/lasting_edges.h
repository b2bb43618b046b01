#pragma once
// Edges that last: the pixels of a keyframe that a run found again in several other keyframes, each in
// another light.
//
// The other label beside the true edges (simulation/true_edge_labels.h): what a scene's geometry and paint
// draw may not survive the next change of light, and what survives is what odometry can use. A run under
// `mixed` light makes the map of whole edges, keyframe by keyframe; a pixel lasts where its depth shows an
// edge of like direction in at least EdgeMapParams::min_views others (edge_map/edge_depth.h).
#include <opencv2/core.hpp>
#include <vector>

#include "edgevo/simulation/scene.h"

namespace edgevo::training {

/// A frame of a scene and what is to be found in it.
struct LabelledFrame {
  int frame = 0;  ///< index in the scene
  cv::Mat label;  ///< CV_8U, as large as the image, not 0: an edge
};

/// The keyframes of one run through the scene, in order of time; the light follows from the seed, and the
/// same seed gives the same labels. Edges in frames that the run lost are none. The camera must be without
/// distortion. Cost: about 0.1 s a frame.
std::vector<LabelledFrame> lasting_edges(const Scene& scene, uint64_t seed);

}  // namespace edgevo::training
