// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/frame_evaluation/evaluate_frames.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "edgevo/core/angle.h"
#include "run_with_truth.h"
#include "truth_mount.h"

namespace edgevo {
namespace {
constexpr int kMinLocalSteps = 5;  // that make the scale of ten frames

using FrameErrors = std::vector<FrameError>;

int last_ahead(const FrameErrors& frames, int i, const FrameEvaluationOptions& options) {
  return std::min(i + options.ahead_frames, int(frames.size()) - 1);
}

// ---- what the program says ----

bool is_alarm(const ReportedFrame& c, const FrameEvaluationOptions& options) {
  return !c.T_world_cam || c.state != TrackingState::kTracking || c.p_right < options.p_threshold;
}

double score_of(const ReportedFrame& c) {
  if (!c.T_world_cam) return 0;
  if (!std::isnan(c.p_right)) return c.p_right;
  if (c.state == TrackingState::kTracking) return 1;
  return c.state == TrackingState::kDegraded ? 0.5 : 0;
}

void add_reports(const std::vector<ReportedFrame>& reported, const FrameEvaluationOptions& options,
                 FrameErrors* frames) {
  for (size_t i = 0; i < reported.size(); ++i) {
    FrameError& error = (*frames)[i];
    error.alarm = is_alarm(reported[i], options);
    error.score = 1;
    for (int k = int(i); k <= last_ahead(*frames, int(i), options); ++k)
      error.score = std::min(error.score, score_of(reported[size_t(k)]));
  }
}

// ---- the motion from a frame ----

int end_of_motion(const RunWithTruth& run, int i, const FrameEvaluationOptions& options) {
  if (!run.is_comparable(i) || run.reported(i).state == TrackingState::kBootstrapping) return -1;
  for (int end = std::min(i + options.ahead_frames, run.size() - 1); end >= i + options.fewest_ahead_frames;
       --end)
    if (run.is_comparable(end) && run.segment(end) == run.segment(i)) return end;
  return -1;
}

// Bound on the effect of the truth's noise on a true motion of that length, metres.
double noise_m(const TruthNoise& noise, double length_m) {
  return kNoiseSigmas * (kOfTwo * noise.position_m + noise.rotation_rad * length_m);
}

void measure(const RunWithTruth& run, const StepScale& scales, int i, const FrameEvaluationOptions& options,
             FrameError* error) {
  const SE3 is = run.motion(i, error->end), ought = run.true_motion(i, error->end);
  error->length_m = ought.translation().norm();
  error->miss_deg = deg(is.rotation().angularDistance(ought.rotation()));
  if (error->end == i + options.ahead_frames) error->p_end = run.reported(error->end).p_right;
  const std::optional<double> scale =
      scales.before(run.segment(i), i, options.scale_frames, options.fewest_scale_steps);
  if (scale) {
    error->units_per_m = *scale;
    error->miss_m = (is.translation() / *scale - ought.translation()).norm();
    error->miss_of_depth = error->miss_m * *scale / run.depth(i);
    const auto local = scales.between(run.segment(i), i, i + options.ahead_frames, kMinLocalSteps);
    if (local) error->scale_ratio = *local / *scale;
  } else if (run.stands(run.segment(i))) {
    error->miss_of_depth = is.translation().norm() / run.depth(i);
  }
}

enum class Side { kRight, kWrong, kUnknown };

// Side of the bound of an error that is known to +- noise.
Side side_of(double error, double noise, double bound) {
  if (error - noise > bound) return Side::kWrong;
  return error + noise <= bound ? Side::kRight : Side::kUnknown;  // NaN: unknown
}

// Wrong only above both bounds.
Side both(Side a, Side b) {
  if (a == Side::kRight || b == Side::kRight) return Side::kRight;
  return a == Side::kWrong && b == Side::kWrong ? Side::kWrong : Side::kUnknown;
}

Side side_of_translation(const TruthNoise& noise, const FrameEvaluationOptions& options,
                         const FrameError& error) {
  if (std::isnan(error.miss_of_depth)) return Side::kUnknown;
  if (std::isnan(error.miss_m)) return side_of(error.miss_of_depth, 0, options.miss_of_depth);
  const double m = noise_m(noise, error.length_m),
               of_depth = error.miss_m > 0 ? error.miss_of_depth / error.miss_m : 0;
  return both(side_of(error.miss_m, m, options.miss_of_length * error.length_m),
              side_of(error.miss_of_depth, m * of_depth, options.miss_of_depth));
}

void decide(const TruthNoise& noise, bool is_depth_known, const FrameEvaluationOptions& options,
            FrameError* error) {
  const Side turn =
      side_of(error->miss_deg, kNoiseSigmas * kOfTwo * deg(noise.rotation_rad), options.miss_deg);
  const Side move = side_of_translation(noise, options, *error);
  error->wrong = turn == Side::kWrong || move == Side::kWrong;
  error->is_evaluated = error->wrong || (turn == Side::kRight && move == Side::kRight);
  error->below_noise = !error->is_evaluated && is_depth_known;
}

// ---- frames next to each other ----

void relate(const FrameEvaluationOptions& options, FrameErrors* frames) {
  int last_wrong = -options.ahead_frames - 1;
  for (int i = 0; i < int(frames->size()); ++i) {
    FrameError& error = (*frames)[size_t(i)];
    if (!error.is_evaluated) continue;
    error.aftermath = !error.wrong && i - last_wrong <= options.ahead_frames;
    if (!error.wrong) continue;
    last_wrong = i;
    for (int k = i; k <= last_ahead(*frames, i, options); ++k) error.noticed |= (*frames)[size_t(k)].alarm;
  }
}

int longest_unnoticed(const FrameErrors& frames) {
  int longest = 0, now = 0;
  for (const FrameError& error : frames) {
    if (error.alarm || (error.is_evaluated && (!error.wrong || error.noticed)))
      now = 0;
    else if (error.is_evaluated)
      longest = std::max(longest, ++now);
  }
  return longest;
}

// ---- scale since the last word ----

// Marks the frames of one segment and returns the longest interval.
int find_off_scale(const RunWithTruth& run, const StepScale& scales, int segment,
                   const FrameEvaluationOptions& options, FrameErrors* frames) {
  int longest = 0, now = 0;
  std::optional<double> since;
  bool is_new = true;
  for (int i = 0; i < run.size(); ++i) {
    FrameError& error = (*frames)[size_t(i)];
    if (error.alarm) is_new = true, now = 0;
    if (error.alarm || !run.is_comparable(i) || run.segment(i) != segment) continue;
    if (std::exchange(is_new, false)) since = scales.first_from(segment, i, options.scale_frames);
    const auto local = scales.between(segment, i, i + options.ahead_frames, kMinLocalSteps);
    if (!since || !local) continue;
    const double off = std::max(*local / *since, *since / *local);
    error.off_scale = off > options.scale_factor;
    now = error.off_scale ? now + 1 : 0;
    longest = std::max(longest, now);
  }
  return longest;
}

// ---- covariance ----

// The covariance in metres, plus that of the truth; nothing if it is unknown.
std::optional<Matrix6d> metric_covariance(const ReportedFrame& c, double units_per_m,
                                          const TruthNoise& noise) {
  if (c.covariance.isZero(0) || !c.covariance.allFinite()) return std::nullopt;
  Vector6d unit = Vector6d::Ones(), truth;
  unit.head<3>().setConstant(1 / units_per_m);
  truth << Eigen::Vector3d::Constant(2 * noise.position_m * noise.position_m),
      Eigen::Vector3d::Constant(2 * noise.rotation_rad * noise.rotation_rad);
  const Matrix6d metric = unit.asDiagonal() * c.covariance * unit.asDiagonal();
  return Matrix6d(metric + Matrix6d(truth.asDiagonal()));
}

std::optional<double> nees_of(const RunWithTruth& run, const StepScale& scales, int i,
                              const FrameEvaluationOptions& options) {
  const int ref = run.reported(i).reference;
  if (ref < 0 || ref == i || !run.is_comparable(i) || !run.is_comparable(ref) ||
      run.segment(i) != run.segment(ref))
    return std::nullopt;
  const auto scale = scales.before(run.segment(i), i, options.scale_frames, options.fewest_scale_steps);
  if (!scale) return std::nullopt;
  const auto covariance = metric_covariance(run.reported(i), *scale, run.noise());
  if (!covariance) return std::nullopt;
  const SE3 T = run.motion(i, ref);
  const SE3 T_cam_ref(T.rotation(), T.translation() / *scale);
  const Vector6d xi = (T_cam_ref * run.true_motion(i, ref).inverse()).log();
  const double nees = xi.dot(covariance->ldlt().solve(xi));
  return std::isfinite(nees) && nees >= 0 ? std::optional(nees) : std::nullopt;
}

}  // namespace

FrameEvaluation evaluate_frames(const std::vector<ReportedFrame>& reported, const Trajectory& truth,
                                const FrameEvaluationOptions& options) {
  RunWithTruth run(reported, truth, options.stated_noise);
  FrameEvaluation result;
  result.T_body_cam = truth_mount(run, StepScale(run), options.ahead_frames, options.scale_frames,
                                  options.fewest_scale_steps);
  run.set_mount(result.T_body_cam);
  const StepScale scales(run);
  result.noise = run.noise();
  result.frames.resize(reported.size());
  add_reports(reported, options, &result.frames);
  for (int i = 0; i < run.size(); ++i) {
    FrameError& error = result.frames[size_t(i)];
    error.end = end_of_motion(run, i, options);
    if (error.end >= 0)
      measure(run, scales, i, options, &error),
          decide(run.noise(), !std::isnan(run.depth(i)), options, &error);
    if (const auto nees = nees_of(run, scales, i, options)) result.nees.push_back(*nees);
    result.has_p_right |= !std::isnan(reported[size_t(i)].p_right);
    result.has_depth |= reported[size_t(i)].median_depth > 0;
  }
  relate(options, &result.frames);
  result.longest_unnoticed = longest_unnoticed(result.frames);
  for (int s = 0; s < run.segments(); ++s)
    result.longest_off_scale =
        std::max(result.longest_off_scale, find_off_scale(run, scales, s, options, &result.frames));
  return result;
}

}  // namespace edgevo
