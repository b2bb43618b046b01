// SPDX-License-Identifier: BSD-3-Clause
#include "run_with_truth.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "edgevo/evaluation/time_matching.h"

namespace edgevo {
namespace {

// Shorter true steps, in standard deviations of a step, say nothing about the scale.
constexpr double kStepSigmas = 5;
// Fewer in a segment may be chance: a long step of the truth is more often one that noise has lengthened.
constexpr int kMinSteps = 5;
constexpr int kStrides[] = {1, 2, 5, 10};  // length of a step, frames

using Step = std::vector<ScaleStep>::const_iterator;

std::optional<double> weighted_median(Step first, Step last) {
  std::vector<ScaleStep> steps(first, last);
  std::sort(steps.begin(), steps.end(),
            [](const ScaleStep& a, const ScaleStep& b) { return a.ratio < b.ratio; });
  double total = 0, below = 0;
  for (const ScaleStep& s : steps) total += s.true_m;
  for (const ScaleStep& s : steps)
    if (below += s.true_m; 2 * below >= total) return s.ratio > 0 ? std::optional(s.ratio) : std::nullopt;
  return std::nullopt;
}

}  // namespace

RunWithTruth::RunWithTruth(const std::vector<ReportedFrame>& reported, const Trajectory& truth,
                           const TruthNoise& stated)
    : reported_(reported), shown_noise_(truth_noise(truth)), noise_(larger_noise(shown_noise_, stated)) {
  const GroundTruth at(truth);
  for (const ReportedFrame& c : reported) truth_.push_back(at.at(c.time));
  find_segments();
  depth_.assign(reported.size(), std::numeric_limits<double>::quiet_NaN());
  carry_depths(0, size(), 1);
  carry_depths(size() - 1, -1, -1);
  find_standing();
}

void RunWithTruth::set_mount(const SE3& T_body_cam) {
  for (std::optional<SE3>& T : truth_)
    if (T) T = *T * T_body_cam;
  find_standing();
}

void RunWithTruth::find_segments() {
  std::map<int, int> number;
  for (const ReportedFrame& c : reported_)
    segment_.push_back(c.T_world_cam ? number.emplace(c.segment, int(number.size())).first->second : -1);
  segments_ = int(number.size());
}

void RunWithTruth::carry_depths(int begin, int end, int step) {
  std::vector<double> last(size_t(segments_), std::numeric_limits<double>::quiet_NaN());
  for (int i = begin; i != end; i += step) {
    if (segment(i) < 0) continue;
    double& known = last[size_t(segment(i))];
    if (reported(i).median_depth > 0) known = reported(i).median_depth;
    if (std::isnan(depth(i))) depth_[size_t(i)] = known;
  }
}

void RunWithTruth::find_standing() {
  std::vector<int> first(size_t(segments_), -1);
  stands_.assign(size_t(segments_), true);
  for (int i = 0; i < size(); ++i) {
    if (!is_comparable(i)) continue;
    int& from = first[size_t(segment(i))];
    if (from < 0) from = i;
    const double moved = true_motion(from, i).translation().norm();
    if (moved > kNoiseSigmas * kOfTwo * shown_noise_.position_m) stands_[size_t(segment(i))] = false;
  }
}

namespace {

struct FoundSteps {
  std::vector<std::vector<ScaleStep>> of_segment;
  bool are_most_long = false;
};

FoundSteps find_steps(const RunWithTruth& run, int stride) {
  FoundSteps found;
  found.of_segment.resize(size_t(run.segments()));
  const double shortest = kStepSigmas * kOfTwo * run.noise().position_m;
  int all = 0, some = 0;
  for (int i = 0; i + stride < run.size(); ++i) {
    const int k = i + stride;
    if (!run.is_comparable(i) || !run.is_comparable(k) || run.segment(i) != run.segment(k)) continue;
    const double true_m = run.true_motion(i, k).translation().norm();
    ++all;
    if (!(true_m > shortest)) continue;
    ++some;
    found.of_segment[size_t(run.segment(i))].push_back(
        {i, true_m, run.motion(i, k).translation().norm() / true_m});
  }
  found.are_most_long = 2 * some > all;
  return found;
}

}  // namespace

StepScale::StepScale(const RunWithTruth& run) {
  for (const int stride : kStrides) {
    FoundSteps found = find_steps(run, stride);
    stride_ = stride;
    steps_ = std::move(found.of_segment);
    if (found.are_most_long) return;
  }
}

StepScale::Steps::const_iterator StepScale::first_at(int segment, int frame) const {
  const Steps& steps = steps_[size_t(segment)];
  return std::lower_bound(steps.begin(), steps.end(), frame,
                          [](const ScaleStep& s, int f) { return s.from < f; });
}

std::optional<double> StepScale::between(int segment, int begin, int end, int fewest) const {
  const Step first = first_at(segment, begin), last = first_after(segment, end);
  const int possible = std::max(1, end - begin + 1 - stride_);
  return last - first < std::min(fewest, possible) ? std::nullopt : weighted_median(first, last);
}

std::optional<double> StepScale::before(int segment, int i, int most, int fewest) const {
  const Steps& steps = steps_[size_t(segment)];
  if (int(steps.size()) < kMinSteps) return std::nullopt;
  const auto enough = std::min<std::ptrdiff_t>(fewest, std::ptrdiff_t(steps.size()));
  const Step last = std::max(first_after(segment, i), steps.begin() + enough);
  const Step first = last - std::min<std::ptrdiff_t>(most, last - steps.begin());
  const std::optional<double> scale = weighted_median(first, last);
  return scale ? scale : weighted_median(steps.begin(), steps.end());
}

std::optional<double> StepScale::first_from(int segment, int begin, int count) const {
  const Steps& steps = steps_[size_t(segment)];
  const Step first = first_at(segment, begin);
  return weighted_median(first, first + std::min<std::ptrdiff_t>(count, steps.end() - first));
}

}  // namespace edgevo
