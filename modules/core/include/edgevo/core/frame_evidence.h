// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Measurements that show whether the pose of a frame can be trusted: collected while the frame is processed
// and written to frames.csv. They contain no decision; confidence/frame_status.h derives the status from
// them. NaN: unknown.
#include <array>
#include <cstdint>
#include <limits>
#include <optional>

namespace edgevo {

/// What the adjustment of the window with a new keyframe showed.
struct AdjustmentEvidence {
  /// Squared difference between the tracked and the adjusted pose of the keyframe, normalised by the
  /// covariance of tracking, per degree of freedom; 1: as large as expected.
  double moved = std::numeric_limits<double>::quiet_NaN();
  /// Robust cost per match, sigmas squared.
  double cost_per_match = 0;
  /// Number of matches that were adjusted.
  int matches = 0;
  /// Number of points with such matches.
  int points = 0;
  /// Number of these matches that are in the new keyframe.
  int matches_in_newest = 0;
  /// Variance by which the logarithm of the unit of length has grown less certain with this keyframe
  /// (mapping/window.h); 0: not at all.
  double unit_variance = 0;
};

/// What corners that are followed through the images say about the poses as reported. They move by
/// themselves: rotation, direction and relative lengths come from the corners alone, so that a map whose unit
/// changes cannot deceive them. "The ten frames" are the last ten up to this one, "the fifty before" those
/// before the ten.
struct CornerEvidence {
  /// Value of an unknown number.
  static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

  /// Number of corners that were followed into this image.
  int tracks = 0;
  /// Share of those seen for at least eight frames that agree with the poses by the epipolar constraint, 0 to
  /// 1.
  double agreeing_share = kUnknown;
  /// Natural logarithm of the corners' length of the ten frames over that of the poses; its origin is
  /// arbitrary and moves when the corners have to start anew. And its standard deviation.
  double scale = kUnknown, scale_sigma = kUnknown;
  /// Change of `scale` from the fifty frames before to the ten: 0 while the unit of the map holds, log 2 if
  /// the poses' steps have shrunk to a half. And its standard deviation.
  double change_10 = kUnknown, change_10_sigma = kUnknown;
  /// The same from the fifty frames before the last fifty to the last fifty: a unit that creeps.
  double change_50 = kUnknown, change_50_sigma = kUnknown;
  /// Distance between the poses' motion over the ten frames, in the scale of the fifty before, and that of
  /// the corners: as a share of the poses' motion, its standard deviation, and in median depths of the
  /// corners.
  double motion_error = kUnknown, motion_sigma = kUnknown, motion_error_depths = kUnknown;
  /// Angle between the rotations over the ten frames, and the standard deviation of the corners', degrees.
  double rotation_deg = kUnknown, rotation_sigma_deg = kUnknown;
  /// Angle between the directions of the motion over the ten frames, 0 to 180, and its standard deviation,
  /// degrees; large where the camera moves too little.
  double direction_deg = kUnknown, direction_sigma_deg = kUnknown;
};

/// The map's unit of length after a doubt, compared with that before it by features that views of both show.
struct RelativeScale {
  /// Lengths of the map before over those after; NaN: nothing links the two, their ratio is unknown.
  double ratio = std::numeric_limits<double>::quiet_NaN();
  /// Standard deviation of the ratio's logarithm; NaN with an unknown ratio.
  double sigma = std::numeric_limits<double>::quiet_NaN();
  /// Whether it was the camera's height over the ground that linked them.
  bool by_ground = false;
  /// Whether the ratio is known.
  bool is_linked() const { return ratio > 0; }  // false for NaN
};

/// What is wrong with an image as a whole (edges/exposure_check.h).
enum class ImageFault : uint8_t {
  /// Nothing.
  kNone,
  /// Black, white or covered: it shows noise alone. A view that is only dark is no blank.
  kBlank,
  /// Every pixel is that of the image before.
  kRepeated,
  /// A part is of an earlier image (edges/exposure_check.h).
  kTorn,
  /// Every second row is of another time.
  kInterlaced,
  /// Every second pixel and row is of another colour: a raw Bayer mosaic.
  kMosaic
};

/// Evidence on one frame.
struct FrameEvidence {
  /// What is wrong with the image.
  ImageFault fault = ImageFault::kNone;
  /// Number of edge pixels on the finest level.
  int edges = 0;
  /// Share of the image's pixels that are black or white, 0 to 1 (edges/image_quality.h).
  double saturated_share = std::numeric_limits<double>::quiet_NaN();
  /// Blur of the edges, 0 to 1: 0.46 for a sharp step, more for blurred ones (edges/image_quality.h).
  double edge_blur = std::numeric_limits<double>::quiet_NaN();
  /// Median depth of the map as its newest keyframe sees it, in the unit of the run (during the run in that
  /// of the segment's map, as the covariance); NaN without a pose.
  double median_depth = std::numeric_limits<double>::quiet_NaN();

  /// Whether the alignment ended at a pose that is not finite.
  bool diverged = false;
  /// Whether the camera is known to stand (segmentation/stationary_detector.h): most edges near enough to
  /// show a typical step keep their place, and the pose keeps its own.
  bool stands = false;
  /// Number of map points in view; nothing if the frame was not tracked.
  std::optional<int> visible_points;
  /// Number of these points with an edge match; nothing if the frame was not tracked.
  std::optional<int> matched_points;
  /// Share of the map points in view that are inliers of the pose (alignment/pose_evidence.h), 0 to 1; 0: not
  /// tracked.
  double inlier_share = 0;
  /// RMS residual of the matched points along the edge normal, pixels; 0: not tracked.
  double residual_px = 0;
  /// Standard deviations of the pose along its principal directions, ascending; translation in median
  /// depths, rotation in radians.
  std::array<double, 6> pose_sigmas = unknown_sigmas();
  /// Largest difference, over the camera's axes, between the translation since the frame before and the
  /// median of the last ones, in their standard deviations (tracking/median_motion_prior.h).
  double step_sigmas = std::numeric_limits<double>::quiet_NaN();

  /// Number of points with known depth in the reference keyframe; nothing if the frame was not tracked.
  std::optional<int> known_points;
  /// Share of the known points wanted for tracking that the reference keyframe lacks, 0 to 1.
  double lacking_share = std::numeric_limits<double>::quiet_NaN();
  /// Share of the map that lies in the image of the reference keyframe, 0 to 1.
  double view_share = std::numeric_limits<double>::quiet_NaN();

  /// Length by which the translation over the last ten frames, as reported, differs from that which was
  /// tracked from frame to frame, median depths: adjustments of keyframes have moved the camera by so much.
  double moved_by_map = std::numeric_limits<double>::quiet_NaN();

  /// Adjustment of the window with this frame as the new keyframe; nothing if there was none.
  std::optional<AdjustmentEvidence> adjustment;

  /// True focal length over the one in use (ImageCorrection), less 1, as corners show it that are followed
  /// without the map (self_calibration/focal_by_corners.h).
  double focal_error = std::numeric_limits<double>::quiet_NaN();
  /// Its standard deviation.
  double focal_error_sigma = std::numeric_limits<double>::quiet_NaN();

  /// The unit of length, at the first frame that is sure again after a doubt, as known then or later; nothing
  /// elsewhere, and where the map is still seen from a keyframe of before.
  std::optional<RelativeScale> unit;

  /// What corners say about the pose; nothing without a pose, and with health.corners off.
  std::optional<CornerEvidence> corners;

  /// Value of `pose_sigmas` for a pose without a covariance.
  static std::array<double, 6> unknown_sigmas() {
    std::array<double, 6> sigmas;
    sigmas.fill(std::numeric_limits<double>::quiet_NaN());
    return sigmas;
  }
};

}  // namespace edgevo
