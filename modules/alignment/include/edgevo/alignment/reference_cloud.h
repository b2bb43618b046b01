#pragma once
// What a frame is tracked against: the newest keyframe's image and the map points seen in it.
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "edgevo/alignment/patch_template.h"
#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// A map point as the reference keyframe sees it.
struct CloudPoint {
  Eigen::Vector3d ray;        ///< (x, y, 1) in the reference camera
  double idepth = 0;          ///< 1/z in the reference camera
  double idepth_sigma = 0;    ///< one standard deviation
  Eigen::Vector2f px;         ///< in the reference image, finest level
  Eigen::Vector2f normal;     ///< unit gradient there
  /// Name of the point for as long as it is in the map: its keyframe and edge pixel there. -1: its depth is still being found.
  int host_keyframe = -1, host_pixel = -1;
};

/// The reference keyframe: its image, the points and their patches. Immutable while frames are tracked.
struct ReferenceCloud {
  std::shared_ptr<const FramePyramid> pyramid;  ///< of the reference image
  std::vector<CloudPoint> points;  ///< in the reference camera's frame
  std::vector<PatchTemplates> patches;           ///< one for each pyramid level, normalised intensity
  PatchTemplates gradient_patches;               ///< finest level, gradient magnitude; empty unless requested
};

/// Cuts the patches of all levels. Cost: 2 to 3 ms for 1500 points.
ReferenceCloud make_reference_cloud(std::shared_ptr<const FramePyramid> pyramid, std::vector<CloudPoint> points,
                                    bool with_gradient_patches);

}  // namespace edgevo
