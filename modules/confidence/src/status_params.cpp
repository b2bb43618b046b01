// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/confidence/status_params.h"

namespace edgevo {

void StepGateParams::visit(ParamVisitor& v) {
  v.number(
      kExperimental, "times", times, 1, 1e6,
      "a step of more than so many usual ones is an outlier: between frames no camera speeds up so much");
  v.number(
      kExperimental, "small", small, 0, 1,
      "median depths a frame up to which a step is a small one: a camera that stood still starts with it");
}

void ConsistencyParams::visit(ParamVisitor& v) {
  constexpr ParamLevel kLevel = kExperimental;
  v.number(
      kLevel, "corner_length_sigmas", corner_length_sigmas, 0, 10,
      "standard deviations by which lengths by corners and by edges may differ: those of right motions do");
  v.number(
      kLevel, "max_scale_sigma", max_scale_sigma, 0.01, 10,
      "standard deviation of the log scale from which on corners know no length: a rotation on the spot");
  v.number(kLevel, "contradicting_share", contradicting_share, 0.01, 1,
           "share of corners off their epipolar lines from which on a rotation is believed to be wrong: of a "
           "right one hardly a corner is");
  v.number(kLevel, "focal_sigmas", focal_sigmas, 0, 10,
           "standard deviations of a focal length that count for nothing: right cameras reach 1.8");
  v.integer(kLevel, "min_corners", min_corners, 0, 1000,
            "corners below which a motion cannot be checked: fewer agree by chance");
  v.number(
      kLevel, "sure_motion_sigma", sure_motion_sigma, 0, 0.2,
      "standard deviation of the corners' motion (share of its length) up to which it checks the motion");
  v.number(kLevel, "vague_motion_sigma", vague_motion_sigma, 0.21, 10,
           "the same, from which on it checks nothing: that of a wrong motion");
  v.number(kLevel, "short_motion", short_motion, 0, 1,
           "median depths in ten frames below which a motion is too short to be wrong in its length");
  v.number(kLevel, "no_information_sigma", no_information_sigma, 1e-3, 10,
           "standard deviation of a pose (share of depth, rad) from which on the image, too, checks nothing");
  v.number(kLevel, "min_turn_rad", min_turn_rad, 1e-3, 3,
           "radians in ten frames from which on a turn shows how much translation a turn makes");
  v.number(kLevel, "first_turn_error", first_turn_error, 0, 1,
           "that translation until it is measured, median depths per radian: of a Kinect's rolling shutter");
  v.number(kLevel, "usual_residual_px", usual_residual_px, 0.01, 10,
           "RMS distance of edges from the map in right runs, pixels; more counts by its logarithm");
  v.number(kLevel, "many_inliers", many_inliers, 0.51, 1, "inlier share from which on nothing is lacking");
  v.number(kLevel, "few_inliers", few_inliers, 0, 0.5,
           "inlier share that counts as 1: below it a frame is DEGRADED anyway");
  v.number(kLevel, "many_points", many_points, 1, 1e4, "points of known depth from which on none is lacking");
  v.number(kLevel, "wide_view_share", wide_view_share, 0.01, 1,
           "share of the map in view from which on none is lacking");
  v.number(kLevel, "sharp_blur", sharp_blur, 0, 1, "blur of edges up to which an image counts as sharp");
  v.number(kLevel, "blur_range", blur_range, 0.01, 1, "blur beyond the usual one that counts as 1");
  v.number(kLevel, "saturated_range", saturated_range, 0.01, 1,
           "share of saturated pixels beyond the usual one that counts as 1");
  v.number(
      kLevel, "max_unproven", max_unproven, 0, 3,
      "most that unusual steps or moved keyframes count: cameras that speed up and new views do the same");
}

void VetoParams::visit(ParamVisitor& v) {
  v.number(kExperimental, "p_right", p_right, 0, 0.4,
           "largest probability of a right motion where one test decides: well below the doubtful ones");
  v.number(kExperimental, "motion", motion, 0, 4,
           "contradiction by corners that decides alone, 1 being a wrong motion: that of no right frame on a "
           "camera that moves evenly; from 3.01 on none does");
  v.number(kExperimental, "focal_length", focal_length, 0, 4,
           "error of a turn by a wrong focal length that decides alone, in 3 degrees: no other test sees it");
}

void ConfidenceParams::visit(ParamVisitor& v) {
  {
    const auto g = v.group("step");
    step.visit(v);
  }
  {
    const auto g = v.group("veto");
    veto.visit(v);
  }
  {
    const auto g = v.group("consistency");
    consistency.visit(v);
  }
}

}  // namespace edgevo
