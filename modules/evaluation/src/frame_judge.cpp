// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/evaluation/frame_judge.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "edgevo/core/angle.h"
#include "judged_run.h"
#include "truth_mount.h"

namespace edgevo {
namespace {
constexpr int kMinLocalSteps = 5;  // that make the scale of ten frames

using FrameVerdicts = std::vector<FrameVerdict>;

int last_ahead(const FrameVerdicts& frames, int i, const JudgementRules& rules) {
  return std::min(i + rules.ahead_frames, int(frames.size()) - 1);
}

// ---- what the program says ----

bool is_alarm(const ClaimedFrame& c, const JudgementRules& rules) {
  return !c.T_world_cam || c.state != TrackingState::kTracking || c.p_right < rules.p_threshold;
}

double score_of(const ClaimedFrame& c) {
  if (!c.T_world_cam) return 0;
  if (!std::isnan(c.p_right)) return c.p_right;
  if (c.state == TrackingState::kTracking) return 1;
  return c.state == TrackingState::kDegraded ? 0.5 : 0;
}

void hear(const std::vector<ClaimedFrame>& claims, const JudgementRules& rules, FrameVerdicts* frames) {
  for (size_t i = 0; i < claims.size(); ++i) {
    FrameVerdict& v = (*frames)[i];
    v.alarm = is_alarm(claims[i], rules);
    v.score = 1;
    for (int k = int(i); k <= last_ahead(*frames, int(i), rules); ++k)
      v.score = std::min(v.score, score_of(claims[size_t(k)]));
  }
}

// ---- the motion from a frame ----

int end_of_motion(const JudgedRun& run, int i, const JudgementRules& rules) {
  if (!run.is_comparable(i) || run.claim(i).state == TrackingState::kBootstrapping) return -1;
  for (int end = std::min(i + rules.ahead_frames, run.size() - 1); end >= i + rules.fewest_ahead_frames;
       --end)
    if (run.is_comparable(end) && run.segment(end) == run.segment(i)) return end;
  return -1;
}

// Bound on the effect of the truth's noise on a true motion of that length, metres.
double noise_m(const TruthNoise& noise, double length_m) {
  return kNoiseSigmas * (kOfTwo * noise.position_m + noise.rotation_rad * length_m);
}

void measure(const JudgedRun& run, const StepScale& scales, int i, const JudgementRules& rules,
             FrameVerdict* v) {
  const SE3 is = run.motion(i, v->end), ought = run.true_motion(i, v->end);
  v->length_m = ought.translation().norm();
  v->miss_deg = deg(is.rotation().angularDistance(ought.rotation()));
  if (v->end == i + rules.ahead_frames) v->p_end = run.claim(v->end).p_right;
  const std::optional<double> scale =
      scales.before(run.segment(i), i, rules.scale_frames, rules.fewest_scale_steps);
  if (scale) {
    v->units_per_m = *scale;
    v->miss_m = (is.translation() / *scale - ought.translation()).norm();
    v->miss_of_depth = v->miss_m * *scale / run.depth(i);
    const auto local = scales.between(run.segment(i), i, i + rules.ahead_frames, kMinLocalSteps);
    if (local) v->scale_ratio = *local / *scale;
  } else if (run.stands(run.segment(i))) {
    v->miss_of_depth = is.translation().norm() / run.depth(i);
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

Side side_of_translation(const TruthNoise& noise, const JudgementRules& rules, const FrameVerdict& v) {
  if (std::isnan(v.miss_of_depth)) return Side::kUnknown;
  if (std::isnan(v.miss_m)) return side_of(v.miss_of_depth, 0, rules.miss_of_depth);
  const double m = noise_m(noise, v.length_m), of_depth = v.miss_m > 0 ? v.miss_of_depth / v.miss_m : 0;
  return both(side_of(v.miss_m, m, rules.miss_of_length * v.length_m),
              side_of(v.miss_of_depth, m * of_depth, rules.miss_of_depth));
}

void decide(const TruthNoise& noise, bool is_depth_known, const JudgementRules& rules, FrameVerdict* v) {
  const Side turn = side_of(v->miss_deg, kNoiseSigmas * kOfTwo * deg(noise.rotation_rad), rules.miss_deg);
  const Side move = side_of_translation(noise, rules, *v);
  v->wrong = turn == Side::kWrong || move == Side::kWrong;
  v->is_judged = v->wrong || (turn == Side::kRight && move == Side::kRight);
  v->below_noise = !v->is_judged && is_depth_known;
}

// ---- frames next to each other ----

void relate(const JudgementRules& rules, FrameVerdicts* frames) {
  int last_wrong = -rules.ahead_frames - 1;
  for (int i = 0; i < int(frames->size()); ++i) {
    FrameVerdict& v = (*frames)[size_t(i)];
    if (!v.is_judged) continue;
    v.aftermath = !v.wrong && i - last_wrong <= rules.ahead_frames;
    if (!v.wrong) continue;
    last_wrong = i;
    for (int k = i; k <= last_ahead(*frames, i, rules); ++k) v.noticed |= (*frames)[size_t(k)].alarm;
  }
}

int longest_unnoticed(const FrameVerdicts& frames) {
  int longest = 0, now = 0;
  for (const FrameVerdict& v : frames) {
    if (v.alarm || (v.is_judged && (!v.wrong || v.noticed)))
      now = 0;
    else if (v.is_judged)
      longest = std::max(longest, ++now);
  }
  return longest;
}

// ---- scale since the last word ----

// Marks the frames of one segment and returns the longest interval.
int find_off_scale(const JudgedRun& run, const StepScale& scales, int segment, const JudgementRules& rules,
                   FrameVerdicts* frames) {
  int longest = 0, now = 0;
  std::optional<double> since;
  bool is_new = true;
  for (int i = 0; i < run.size(); ++i) {
    FrameVerdict& v = (*frames)[size_t(i)];
    if (v.alarm) is_new = true, now = 0;
    if (v.alarm || !run.is_comparable(i) || run.segment(i) != segment) continue;
    if (std::exchange(is_new, false)) since = scales.first_from(segment, i, rules.scale_frames);
    const auto local = scales.between(segment, i, i + rules.ahead_frames, kMinLocalSteps);
    if (!since || !local) continue;
    const double off = std::max(*local / *since, *since / *local);
    v.off_scale = off > rules.scale_factor;
    now = v.off_scale ? now + 1 : 0;
    longest = std::max(longest, now);
  }
  return longest;
}

// ---- covariance ----

// The covariance in metres, plus that of the truth; nothing if it is unknown.
std::optional<Matrix6d> metric_covariance(const ClaimedFrame& c, double units_per_m,
                                          const TruthNoise& noise) {
  if (c.covariance.isZero(0) || !c.covariance.allFinite()) return std::nullopt;
  Vector6d unit = Vector6d::Ones(), truth;
  unit.head<3>().setConstant(1 / units_per_m);
  truth << Eigen::Vector3d::Constant(2 * noise.position_m * noise.position_m),
      Eigen::Vector3d::Constant(2 * noise.rotation_rad * noise.rotation_rad);
  const Matrix6d metric = unit.asDiagonal() * c.covariance * unit.asDiagonal();
  return Matrix6d(metric + Matrix6d(truth.asDiagonal()));
}

std::optional<double> nees_of(const JudgedRun& run, const StepScale& scales, int i,
                              const JudgementRules& rules) {
  const int ref = run.claim(i).reference;
  if (ref < 0 || ref == i || !run.is_comparable(i) || !run.is_comparable(ref) ||
      run.segment(i) != run.segment(ref))
    return std::nullopt;
  const auto scale = scales.before(run.segment(i), i, rules.scale_frames, rules.fewest_scale_steps);
  if (!scale) return std::nullopt;
  const auto covariance = metric_covariance(run.claim(i), *scale, run.noise());
  if (!covariance) return std::nullopt;
  const SE3 T = run.motion(i, ref);
  const SE3 T_cam_ref(T.rotation(), T.translation() / *scale);
  const Vector6d xi = (T_cam_ref * run.true_motion(i, ref).inverse()).log();
  const double nees = xi.dot(covariance->ldlt().solve(xi));
  return std::isfinite(nees) && nees >= 0 ? std::optional(nees) : std::nullopt;
}

}  // namespace

RunJudgement judge_frames(const std::vector<ClaimedFrame>& claims, const Trajectory& truth,
                          const JudgementRules& rules) {
  JudgedRun run(claims, truth, rules.stated_noise);
  RunJudgement result;
  result.T_body_cam =
      truth_mount(run, StepScale(run), rules.ahead_frames, rules.scale_frames, rules.fewest_scale_steps);
  run.set_mount(result.T_body_cam);
  const StepScale scales(run);
  result.noise = run.noise();
  result.frames.resize(claims.size());
  hear(claims, rules, &result.frames);
  for (int i = 0; i < run.size(); ++i) {
    FrameVerdict& v = result.frames[size_t(i)];
    v.end = end_of_motion(run, i, rules);
    if (v.end >= 0)
      measure(run, scales, i, rules, &v), decide(run.noise(), !std::isnan(run.depth(i)), rules, &v);
    if (const auto nees = nees_of(run, scales, i, rules)) result.nees.push_back(*nees);
    result.has_p_right |= !std::isnan(claims[size_t(i)].p_right);
    result.has_depth |= claims[size_t(i)].median_depth > 0;
  }
  relate(rules, &result.frames);
  result.longest_unnoticed = longest_unnoticed(result.frames);
  for (int s = 0; s < run.segments(); ++s)
    result.longest_off_scale =
        std::max(result.longest_off_scale, find_off_scale(run, scales, s, rules, &result.frames));
  return result;
}

}  // namespace edgevo
