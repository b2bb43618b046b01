// SPDX-License-Identifier: BSD-3-Clause
// edgevo_fit_trust RUNS.txt TABLE.h REPORT.md: fits the trust in a frame (confidence/motion_confidence.h) to runs with
// ground truth. RUNS.txt: written by trust_corpus.py. TABLE.h: the weights, for
// modules/confidence/src/trust_table.h. REPORT.md: how good the fit is on cameras that it excluded, also without
// each test.
#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <set>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/frame_evaluation/frame_figures.h"
#include "monotone_fit.h"
#include "trust_runs.h"
#include "trust_table_text.h"

namespace edgevo::training {
namespace {

constexpr double kRidge = 2;  // in samples
// Share of the wrong motions that no test shows, chosen: a hand-held camera whose file is 20 % off shows nothing in
// its corners, edges or adjustments.
constexpr double kUnseen = 0.05;
constexpr double kFalseAlarms = 0.02;

// The evaluated motions of ten frames of a run: doubts at their end. Where the focal length is to blame the other
// tests have nothing to explain.
std::vector<EvaluatedMotion> samples_of(const TrustRun& run) {
  std::vector<EvaluatedMotion> samples;
  for (size_t i = 0; i < run.evaluation.frames.size(); ++i) {
    const FrameError& v = run.evaluation.frames[i];
    if (!v.is_evaluated || v.end < 0 || size_t(v.end) != i + 10 || !run.doubts[size_t(v.end)] ||
        run.p_wrong_otherwise[size_t(v.end)] > 0.5)
      continue;
    samples.push_back({*run.doubts[size_t(v.end)], v.wrong});
  }
  return samples;
}

using Runs = std::vector<const TrustRun*>;

// Every camera weighs as much as any other.
std::vector<EvaluatedMotion> pooled(const Runs& runs) {
  std::map<std::string, std::vector<EvaluatedMotion>> by_camera;
  for (const TrustRun* run : runs)
    for (const EvaluatedMotion& s : samples_of(*run)) by_camera[run->camera].push_back(s);
  std::vector<EvaluatedMotion> all;
  size_t total = 0;
  for (const auto& camera : by_camera) total += camera.second.size();
  for (auto& [camera, samples] : by_camera)
    for (EvaluatedMotion& s : samples) {
      s.weight = double(total) / double(by_camera.size()) / double(samples.size());
      all.push_back(s);
    }
  return all;
}

// A test that shows always the same gets no weight.
FittedTrust fit_to(const Runs& runs, std::optional<ConsistencyTest> without) {
  std::vector<EvaluatedMotion> samples = pooled(runs);
  if (without)
    for (EvaluatedMotion& s : samples) s.doubts[size_t(*without)] = 0;
  FittedTrust fitted;
  fitted.sum = fit_logistic(samples, kRidge, kUnseen);
  return fitted;
}

// Of a frame that the trust was built for.
double p_right_by(const FittedTrust& fitted, const TrustRun& run, size_t frame) {
  return fitted.sum.p_right(*run.doubts[frame]) * (1 - run.p_wrong_otherwise[frame]);
}

// The reported of a run with p_right by a fit; below `bound` the state is DEGRADED.
FrameEvaluation evaluated_by(const TrustRun& run, const FittedTrust& fitted, double bound) {
  std::vector<ReportedFrame> reported = run.reported;
  for (size_t i = 0; i < reported.size(); ++i)
    if (run.doubts[i]) reported[i].p_right = p_right_by(fitted, run, i);
  FrameEvaluationOptions rules;
  rules.p_threshold = bound;
  return evaluate_frames(reported, run.truth, rules);
}

// p_right of the frames that are right and follow no wrong one; 0 where the image alone doubts them, so that
// the bound counts all alarms.
void add_right(const TrustRun& run, const FittedTrust& fitted, std::vector<double>* p) {
  for (size_t i = 0; i < run.evaluation.frames.size(); ++i) {
    const FrameError& v = run.evaluation.frames[i];
    if (v.is_evaluated && !v.wrong && !v.aftermath && run.doubts[i])
      p->push_back(v.alarm ? 0.0 : p_right_by(fitted, run, i));
  }
}

struct Fold {
  std::string camera;
  Runs runs;           // of the camera that is excluded
  FittedTrust fitted;  // to the others
};

std::vector<Fold> folds_of(const std::vector<TrustRun>& runs, std::optional<ConsistencyTest> without = {}) {
  std::set<std::string> cameras;
  for (const TrustRun& run : runs) cameras.insert(run.camera);
  std::vector<Fold> folds;
  for (const std::string& camera : cameras) {
    Fold fold{camera, {}, {}};
    Runs others;
    for (const TrustRun& run : runs) (run.camera == camera ? fold.runs : others).push_back(&run);
    fold.fitted = fit_to(others, without);
    folds.push_back(std::move(fold));
  }
  return folds;
}

// Below which at most kFalseAlarms of the right frames of excluded cameras are.
double bound_of(const std::vector<Fold>& folds, size_t* right_frames) {
  std::vector<double> right;
  for (const Fold& fold : folds)
    for (const TrustRun* run : fold.runs) add_right(*run, fold.fitted, &right);
  *right_frames = right.size();
  return conformal_lower_bound(right, kFalseAlarms);
}

FrameFigures figures_by(const std::vector<Fold>& folds, double bound) {
  std::vector<FrameEvaluation> all;
  for (const Fold& fold : folds)
    for (const TrustRun* run : fold.runs) all.push_back(evaluated_by(*run, fold.fitted, bound));
  return figures_of(all);
}

// What each test is worth: fitted without it, at the same share of false alarms.
std::string ablation_of(std::vector<TrustRun> runs) {
  std::vector<NamedFigures> rows;
  const auto add = [&](const std::string& name, const std::vector<Fold>& folds) {
    size_t right = 0;
    rows.push_back({name, figures_by(folds, bound_of(folds, &right))});
  };
  for (size_t k = 0; k < kConsistencyTests; ++k)
    add(std::string("without ") + name_of(ConsistencyTest(k)), folds_of(runs, ConsistencyTest(k)));
  for (TrustRun& run : runs) std::fill(run.p_wrong_otherwise.begin(), run.p_wrong_otherwise.end(), 0.0);
  add("without focal length and unit", folds_of(runs));
  return frame_figures_markdown(rows);
}

std::string report_of(const std::vector<Fold>& folds, const FittedTrust& fitted) {
  std::vector<NamedFigures> cameras, single;
  std::vector<FrameEvaluation> all, by_image;
  for (const Fold& fold : folds) {
    std::vector<FrameEvaluation> of_camera;
    for (const TrustRun* run : fold.runs) {
      of_camera.push_back(evaluated_by(*run, fold.fitted, fitted.bound));
      single.push_back({run->name, figures_of({of_camera.back()})});
      by_image.push_back(run->evaluation);
    }
    cameras.push_back({fold.camera, figures_of(of_camera)});
    all.insert(all.end(), of_camera.begin(), of_camera.end());
  }
  cameras.push_back({"all", figures_of(all)});
  cameras.push_back({"all, by the image alone", figures_of(by_image)});
  std::string text = "Doubtful below p_right " + fixed(fitted.bound, 4) + ".\n\n| doubt | weight |";
  for (const Fold& fold : folds) text += " without " + fold.camera + " |";
  text += "\n|---|---|";
  for (size_t i = 0; i < folds.size(); ++i) text += "---|";
  for (size_t k = 0; k < kConsistencyTests; ++k) {
    text += std::string("\n| ") + name_of(ConsistencyTest(k)) + " | " + fixed(fitted.sum.weights[k], 3) + " |";
    for (const Fold& fold : folds) text += " " + fixed(fold.fitted.sum.weights[k], 3) + " |";
  }
  return text + "\n\nCameras excluded of the fit:\n\n" + frame_figures_markdown(cameras) +
         "\nEach run, its camera excluded:\n\n" + frame_figures_markdown(single);
}

int fit(const std::string& list, const std::string& table, const std::string& report) {
  const std::vector<TrustRun> runs = read_trust_runs(list);
  const std::vector<Fold> folds = folds_of(runs);
  Runs all;
  for (const TrustRun& run : runs) all.push_back(&run);
  FittedTrust fitted = fit_to(all, std::nullopt);
  size_t right = 0;
  fitted.bound = bound_of(folds, &right);
  write_file(table, trust_table_text(fitted, runs.size(), folds.size()));
  write_file(report, report_of(folds, fitted) + "\nFitted without each test, cameras excluded:\n\n" +
                         ablation_of(runs));
  std::printf("%zu runs, %zu cameras, %zu right frames; doubtful below %.4f\n", runs.size(), folds.size(),
              right, fitted.bound);
  return 0;
}

}  // namespace
}  // namespace edgevo::training

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: edgevo_fit_trust RUNS.txt TABLE.h REPORT.md\n");
    return 2;
  }
  try {
    return edgevo::training::fit(argv[1], argv[2], argv[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "edgevo_fit_trust: %s\n", error.what());
    return 2;
  }
}
