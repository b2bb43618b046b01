// SPDX-License-Identifier: BSD-3-Clause
#include "focal_length.h"

#include <cmath>
#include <utility>

#include "edgevo/bundle_adjustment/gauge.h"
#include "edgevo/map/corrected_pixel.h"
#include "edgevo/self_calibration/focal_by_corners.h"

namespace edgevo {
namespace {

// Standard deviations: at which one that is in use is replaced, and at which the file's comes back.
constexpr double kOther = 1, kSameAsFile = 1.5;
// Share of the largest error beyond which the true one may be larger still.
constexpr double kSureUpTo = 0.95;
// Share of the significance at which one is tried first.
constexpr double kTried = 2.0 / 3;
// Cost of the map with a focal length far off the one in use: with true ones it was 0.5 to 1.13 times that
// before, with wrong ones 1.5 to 5.9 (lab 2026-11-27_focal_length_applied).
constexpr double kMaxCost = 1.25;

}  // namespace

std::optional<double> focal_length_to_try(const CameraRefinement& known, double significance) {
  const CameraRefinement::FocalLength& found = known.focal_length;
  const double in_use = known.correction.focal;
  if (!(found.sigma > 0) || found.windows <= found.windows_rejected) return std::nullopt;
  if (std::abs(found.estimate) > kSureUpTo * kMaxFocalError) return std::nullopt;
  const auto try_if = [&](bool tries) { return tries ? std::make_optional(found.estimate) : std::nullopt; };
  if (in_use == 0) return try_if(std::abs(found.estimate) > kTried * significance * found.sigma);
  if (std::abs(found.estimate) < kSameAsFile * found.sigma) return 0.0;
  return try_if(std::abs(found.estimate - in_use) > kOther * found.sigma);
}

bool is_supported_by_map(const CameraRefinement& known, double cost_ratio, double significance) {
  const CameraRefinement::FocalLength& found = known.focal_length;
  const bool is_far_off = std::abs(found.estimate - known.correction.focal) > significance * found.sigma;
  return cost_ratio < (is_far_off ? kMaxCost : 1);
}

// From keyframe to keyframe: over a longer way the first order is not enough.
CameraProblem seen_with_focal_length(CameraProblem problem, double before, double now) {
  const double image_ratio = (1 + before) / (1 + now);
  BaProblem& p = problem.file;
  const BaProblem old = p;
  for (size_t k = 1; k < p.poses.size(); ++k) {
    const SE3 T = old.poses[k].T_cam_world * old.poses[k - 1].T_cam_world.inverse();
    p.poses[k].T_cam_world = correct_motion(T, image_ratio) * p.poses[k - 1].T_cam_world;
  }
  p.prior = ba::fix_baseline(p.poses.front().T_cam_world, p.poses.back().T_cam_world, p.pose_ids.back());
  return problem;
}

}  // namespace edgevo
