// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/frame_evaluation/frame_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

constexpr int kCalibrationBins = 10;

struct Scored {
  double score;
  bool is_wrong;
};

std::optional<double> percent(int part, int whole) {
  return whole > 0 ? std::optional(100.0 * part / whole) : std::nullopt;
}

void count(const FrameEvaluation& run, FrameFigures* f) {
  ++f->runs;
  f->frames += int(run.frames.size());
  for (const FrameError& frame : run.frames) {
    f->frames_evaluated += frame.is_evaluated, f->below_noise += frame.below_noise;
    if (!frame.is_evaluated || frame.aftermath) continue;
    f->wrong += frame.wrong, f->noticed += frame.noticed;
    f->right += !frame.wrong, f->false_alarms += !frame.wrong && frame.alarm;
  }
  f->longest_unnoticed = std::max(f->longest_unnoticed, run.longest_unnoticed);
  f->longest_off_scale = std::max(f->longest_off_scale, run.longest_off_scale);
  f->is_roc_of_state |= !run.has_p_right;
}

// Area under the ROC by ranks.
std::optional<double> roc_of(std::vector<Scored> scored) {
  std::sort(scored.begin(), scored.end(), [](const Scored& a, const Scored& b) { return a.score < b.score; });
  double area = 0, wrong_below = 0, right = 0;
  for (size_t i = 0; i < scored.size();) {
    double wrong_here = 0, right_here = 0;
    const double score = scored[i].score;
    for (; i < scored.size() && scored[i].score == score; ++i)
      (scored[i].is_wrong ? wrong_here : right_here) += 1;
    area += right_here * (wrong_below + 0.5 * wrong_here);
    wrong_below += wrong_here, right += right_here;
  }
  return wrong_below > 0 && right > 0 ? std::optional(area / wrong_below / right) : std::nullopt;
}

std::optional<double> calibration_error(const std::vector<FrameEvaluation>& runs) {
  struct Bin {
    double p = 0, right = 0;
  };
  std::array<Bin, kCalibrationBins> bins;
  int total = 0;
  for (const FrameEvaluation& run : runs)
    for (const FrameError& frame : run.frames) {
      if (!frame.is_evaluated || std::isnan(frame.p_end)) continue;
      Bin& bin = bins[size_t(std::clamp(int(frame.p_end * kCalibrationBins), 0, kCalibrationBins - 1))];
      bin.p += frame.p_end, bin.right += !frame.wrong;
      ++total;
    }
  double error = 0;
  for (const Bin& bin : bins) error += std::abs(bin.p - bin.right);  // of sums: weighted by the frames
  return total > 0 ? std::optional(error / total) : std::nullopt;
}

std::optional<NeesFigures> nees_of(const std::vector<FrameEvaluation>& runs) {
  std::vector<double> all;
  for (const FrameEvaluation& run : runs) all.insert(all.end(), run.nees.begin(), run.nees.end());
  if (all.empty()) return std::nullopt;
  return NeesFigures{int(all.size()), quantile(all, 0.05), quantile(all, 0.5), quantile(all, 0.95)};
}

}  // namespace

FrameFigures figures_of(const std::vector<FrameEvaluation>& runs) {
  FrameFigures f;
  std::vector<Scored> scored;
  for (const FrameEvaluation& run : runs) {
    count(run, &f);
    for (const FrameError& frame : run.frames)
      if (frame.is_evaluated && !frame.aftermath) scored.push_back({frame.score, frame.wrong});
  }
  f.recall_percent = percent(f.noticed, f.wrong);
  f.false_alarm_percent = percent(f.false_alarms, f.right);
  f.roc = roc_of(std::move(scored));
  f.calibration_error = calibration_error(runs);
  f.nees = nees_of(runs);
  return f;
}

namespace {

FrameEvaluations both(const std::vector<ReportedFrame>& live, const std::vector<ReportedFrame>& final,
                      const Trajectory& truth, const FrameEvaluationOptions& options) {
  FrameEvaluations j{evaluate_frames(live, truth, options), evaluate_frames(final, truth, options)};
  j.live.nees = j.final.nees;
  return j;
}

}  // namespace

FrameEvaluations evaluate_frames_of(const Run& run, const Trajectory& truth,
                                    const FrameEvaluationOptions& options) {
  return both(reported_frames(run, PoseSource::kLive), reported_frames(run, PoseSource::kFinal), truth,
              options);
}

FrameEvaluations evaluate_frames_in(const std::string& folder, const Trajectory& truth,
                                    const FrameEvaluationOptions& options) {
  return both(read_reported_frames(folder, PoseSource::kLive),
              read_reported_frames(folder, PoseSource::kFinal), truth, options);
}

}  // namespace edgevo
