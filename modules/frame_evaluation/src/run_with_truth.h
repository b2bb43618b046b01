// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A run next to its truth, and the scale between the two along the run, for evaluate_frames.cpp.
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "edgevo/frame_evaluation/reported_frame.h"
#include "edgevo/frame_evaluation/truth_noise.h"

namespace edgevo {

/// Standard deviations of a difference of two true poses within which it is taken for noise.
constexpr double kNoiseSigmas = 3;
/// Standard deviation of a difference over that of one.
const double kOfTwo = std::sqrt(2.0);

/// The frames of a run with their true poses.
class RunWithTruth {
 public:
  /// Keeps a reference to `reported`. `stated`: FrameEvaluationOptions::stated_noise.
  RunWithTruth(const std::vector<ReportedFrame>& reported, const Trajectory& truth, const TruthNoise& stated);

  /// Takes the truth for that of a body on which the camera is mounted (truth_mount.h): from now on the true
  /// poses are those of the camera.
  void set_mount(const SE3& T_body_cam);
  int size() const { return int(reported_.size()); }
  const TruthNoise& noise() const { return noise_; }
  const ReportedFrame& reported(int i) const { return reported_[size_t(i)]; }
  /// Number of segments with a pose; segment of a frame, from 0, or -1 for a frame without a pose.
  int segments() const { return segments_; }
  int segment(int i) const { return segment_[size_t(i)]; }
  /// Whether the frame has a pose and a true pose.
  bool is_comparable(int i) const { return segment(i) >= 0 && truth_[size_t(i)]; }
  /// Poses of a comparable frame.
  const SE3& pose(int i) const { return *reported(i).T_world_cam; }
  const SE3& true_pose(int i) const { return *truth_[size_t(i)]; }
  /// Motion from frame i to frame k, both comparable: T_i_k, in the unit of the run, and true.
  SE3 motion(int i, int k) const { return pose(i).inverse() * pose(k); }
  SE3 true_motion(int i, int k) const { return true_pose(i).inverse() * true_pose(k); }
  /// Median depth at a frame with a pose, unit of the run: that of the nearest frame before it in the segment
  /// that has one, else after; NaN: the segment has none.
  double depth(int i) const { return depth_[size_t(i)]; }
  /// Whether the true positions of a segment differ by no more than the noise that they show: what a larger
  /// stated noise hides may be a motion.
  bool stands(int segment) const { return stands_[size_t(segment)]; }

 private:
  void find_segments();
  void carry_depths(int begin, int end, int step);
  void find_standing();

  const std::vector<ReportedFrame>& reported_;
  TruthNoise shown_noise_, noise_;
  std::vector<std::optional<SE3>> truth_;
  std::vector<int> segment_;
  std::vector<double> depth_;
  std::vector<bool> stands_;
  int segments_ = 0;
};

/// A step of one segment that is long enough to measure the scale.
struct ScaleStep {
  /// Frame in which it begins.
  int from = 0;
  /// True length, metres, and length of the run over it.
  double true_m = 0, ratio = 0;
};

/// Scale of a run, units per metre, from its steps: the median of their ratios, weighted by the true lengths.
/// A step leads from a frame to the next one; if the noise of the truth hides most of these, to the second,
/// fifth or tenth.
class StepScale {
 public:
  explicit StepScale(const RunWithTruth& run);

  /// Scale of the steps of a segment within the frames begin to end; nothing if there are fewer than `fewest`
  /// (or than fit) or the run stands.
  std::optional<double> between(int segment, int begin, int end, int fewest) const;
  /// Scale of the last `most` steps of a segment before frame i; if there are fewer than `fewest`, of the
  /// first `fewest` of the segment; of all, if it has fewer, or if the run stood.
  /// Nothing if it has fewer than five.
  std::optional<double> before(int segment, int i, int most, int fewest) const;
  /// Scale of the first `count` steps of a segment from frame `begin` on, or of as many as there are.
  std::optional<double> first_from(int segment, int begin, int count) const;

 private:
  using Steps = std::vector<ScaleStep>;
  // First step that begins at `frame` or later, or that ends after it.
  Steps::const_iterator first_at(int segment, int frame) const;
  Steps::const_iterator first_after(int segment, int frame) const {
    return first_at(segment, frame - stride_ + 1);
  }

  int stride_ = 1;
  std::vector<Steps> steps_;
};

}  // namespace edgevo
