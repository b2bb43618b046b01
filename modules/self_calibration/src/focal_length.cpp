// SPDX-License-Identifier: BSD-3-Clause
#include "focal_length.h"

#include <cmath>
#include <utility>

#include "edgevo/bundle_adjustment/gauge.h"
#include "edgevo/map/corrected_pixel.h"
#include "edgevo/self_calibration/focal_by_corners.h"
#include "edgevo/self_calibration/lens_estimate.h"

namespace edgevo {
namespace {

// Share of the largest error beyond which the true one may be larger still.
constexpr double kSureUpTo = 0.95;

}  // namespace

bool is_at_limit(double focal) { return std::abs(focal) > kSureUpTo * kMaxFocalError; }

bool do_corners_contradict(const CameraPosterior& known) {
  const CameraPosterior::Corners& corners = known.corners;
  return corners.sigma > 0 && corners.windows > corners.windows_weighed && !is_at_limit(corners.focal) &&
         std::abs(corners.focal - known.applied.focal) > kImprobable * corners.sigma;
}

CameraSearch search_for_camera(const CameraPosterior& known, bool with_readout, double readout_s) {
  CameraSearch s;
  s.start = known.applied;
  if (do_corners_contradict(known)) s.start.correction.focal = known.corners.focal;
  s.free = only({kK1, kK2, kFocal});
  s.free[kReadout] = with_readout;
  s.prior[kReadout] = readout_s;
  // With k2 free, too, k1 is larger than the residual that is applied alone.
  s.limit[kK1] = kMaxK2;
  return s;
}

FocalPosterior focal_posterior(const CameraPosterior& known, const CameraEstimate& e) {
  const CameraPosterior::Corners& corners = known.corners;
  const double by_matches = e.value.correction.focal, sigma = kSigmasOfMatches * e.sigma[kFocal];
  const double bias = kMissedByMatches * (by_matches - known.applied.focal);
  const double unbiased_weight = 1 / (sigma * sigma), weight = 1 / (sigma * sigma + bias * bias);
  const bool do_corners_count = corners.sigma > 0 && !is_at_limit(corners.focal);
  const double corner_weight = do_corners_count ? 1 / (corners.sigma * corners.sigma) : 0;
  FocalPosterior p;
  p.mean = (weight * by_matches + corner_weight * corners.focal) / (weight + corner_weight);
  p.sigma = 1 / std::sqrt(weight + corner_weight);
  p.sigma_in_use = 1 / std::sqrt(unbiased_weight + corner_weight);
  p.do_matches_agree = std::abs(by_matches) > sigma && by_matches * p.mean > 0;
  return p;
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

CameraProblem started_at(CameraProblem problem, const BaProblem& solution) {
  problem.file.poses = solution.poses, problem.file.prior = solution.prior;
  for (size_t i = 0; i < solution.points.size(); ++i)
    problem.file.points[i].idepth = solution.points[i].idepth;
  return problem;
}

}  // namespace edgevo
