// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/benchmark/evaluated_runs.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>

#include "edgevo/benchmark/source_truth.h"
#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/frame_evaluation/frame_figures.h"
#include "edgevo/results/finished_run.h"
#include "edgevo/simulation/relight.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

struct RunsAndTruth {
  std::vector<std::string> runs;
  std::string truth;  // empty: that of each run
};

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

bool is_run_or_holds_some(const std::string& path) {
  if (!is_folder(path)) return false;
  try {
    return !find_runs(path).empty();
  } catch (const InputError&) {
    return false;
  }
}

RunsAndTruth sort_out(std::vector<std::string> paths) {
  RunsAndTruth found;
  if (paths.size() > 1 && !is_run_or_holds_some(paths.back())) {
    found.truth = paths.back();
    paths.pop_back();
  }
  for (const std::string& path : paths)
    for (const std::string& run : find_runs(path)) found.runs.push_back(run);
  return found;
}

// A job of a benchmark names its variant, whose words may name a change of light; nothing for other runs.
std::optional<bool> has_changed_light(const std::string& run) {
  std::error_code ignored;
  const std::string path = (fs::path(run) / "job.yaml").string();
  if (!fs::exists(path, ignored)) return std::nullopt;
  std::istringstream lines(read_file(path, "remove it"));
  const std::string key = "variant: ";
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(key, 0) != 0) continue;
    std::istringstream words(line.substr(key.size()));
    for (std::string word; std::getline(words, word, '+');)
      if (std::count(relight_kinds().begin(), relight_kinds().end(), word) > 0) return true;
    return false;
  }
  return std::nullopt;
}

class RunReader {
 public:
  RunReader(std::string truth, const RunEvaluationRequest& request)
      : truth_(std::move(truth)), reading_(request.truth_reading) {
    options_.stated_noise = request.stated_noise;
  }

  const Trajectory& truth_of(const std::string& run) {
    const std::string path = truth_.empty() ? read_finished_run(run).ground_truth : truth_;
    if (path.empty())
      throw InputError(run, "its ground truth is not known, or no longer there",
                       "give the ground truth as the last path");
    const auto known = known_.find(path);
    if (known != known_.end()) return known->second;
    Trajectory truth = source_truth(path);
    reread(reading_, &truth);
    return known_.emplace(path, std::move(truth)).first->second;
  }

  FrameEvaluations read(const std::string& run) {
    FrameEvaluations found = evaluate_frames_in(run, truth_of(run), options_);
    if (!found.live.has_depth && !found.final.has_depth)
      throw InputError((fs::path(run) / "frames.csv").string(),
                       "has no median_depth, without which frames cannot be evaluated",
                       "run the sequence again with this version");
    return found;
  }

 private:
  std::string truth_;
  FrameEvaluationOptions options_;
  TrajectoryReading reading_;
  std::map<std::string, Trajectory> known_;
};

std::string evaluate_one(const std::string& run, const RunEvaluationRequest& request, RunReader* reader) {
  const std::string trajectory = (fs::path(run) / "trajectory_tum.txt").string();
  const Trajectory estimate = read_trajectory(trajectory), &truth = reader->truth_of(run);
  const TrajectoryEvaluation e = evaluate(estimate, truth, request.options);
  for (const std::string& hint : alignment_hints(estimate, truth)) request.on_hint(hint);
  const FrameEvaluations found = reader->read(run);
  const std::vector<NamedFigures> rows{{"live", figures_of({found.live})},
                                       {"final", figures_of({found.final})}};
  const TruthNoise& noise = found.live.noise;
  return request.json ? to_json(e, frame_members(rows, noise)) : to_table(e) + frame_section(rows, noise);
}

std::string evaluate_many(const std::vector<std::string>& runs, bool json, RunReader* reader) {
  std::vector<NamedFigures> rows;
  std::vector<FrameEvaluation> all, normal, changed;
  for (const std::string& run : runs) {
    all.push_back(reader->read(run).live);
    rows.push_back({run, figures_of({all.back()})});
    if (const std::optional<bool> light = has_changed_light(run))
      (*light ? changed : normal).push_back(all.back());
  }
  rows.push_back({"all", figures_of(all)});
  if (!normal.empty() && !changed.empty()) {
    rows.push_back({"normal light", figures_of(normal)});
    rows.push_back({"changed light", figures_of(changed)});
  }
  return json ? frame_figures_json(rows) + "\n" : frame_figures_table(rows);
}

}  // namespace

std::string evaluate_runs(const RunEvaluationRequest& request) {
  const RunsAndTruth given = sort_out(request.paths);
  RunReader reader(given.truth, request);
  if (given.runs.size() == 1) return evaluate_one(given.runs.front(), request, &reader);
  return evaluate_many(given.runs, request.json, &reader);
}

}  // namespace edgevo
