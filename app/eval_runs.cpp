// SPDX-License-Identifier: BSD-3-Clause
#include "eval_runs.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/evaluation/judgement_figures.h"
#include "edgevo/results/finished_run.h"
#include "edgevo/simulation/relight.h"

namespace edgevo::app {
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
  RunReader(std::string truth, const TruthNoise& stated_noise,
            std::function<Trajectory(const std::string&)> read)
      : truth_(std::move(truth)), read_(std::move(read)) {
    rules_.stated_noise = stated_noise;
  }

  const Trajectory& truth_of(const std::string& run) {
    const std::string path = truth_.empty() ? read_finished_run(run).ground_truth : truth_;
    if (path.empty())
      throw InputError(run, "its ground truth is not known, or no longer there",
                       "give the ground truth as the last path");
    const auto known = known_.find(path);
    return known != known_.end() ? known->second : known_.emplace(path, read_(path)).first->second;
  }

  RunJudgements read(const std::string& run) {
    RunJudgements found = judge_folder(run, truth_of(run), rules_);
    if (!found.live.has_depth && !found.final.has_depth)
      throw InputError((fs::path(run) / "frames.csv").string(),
                       "has no median_depth, without which frames cannot be evaluated",
                       "run the sequence again with this version");
    return found;
  }

 private:
  std::string truth_;
  JudgementRules rules_;
  std::function<Trajectory(const std::string&)> read_;
  std::map<std::string, Trajectory> known_;
};

void print(const std::string& text) { std::fputs(text.c_str(), stdout); }

void eval_one(const std::string& run, const EvaluationOptions& options, bool json, RunReader* reader) {
  const std::string trajectory = (fs::path(run) / "trajectory_tum.txt").string();
  const Trajectory estimate = read_trajectory(trajectory), &truth = reader->truth_of(run);
  TrajectoryEvaluation e = evaluate(estimate, truth, options);
  for (const std::string& hint : alignment_hints(estimate, truth))
    std::fprintf(stderr, "HINT: %s\n", hint.c_str());
  const RunJudgements found = reader->read(run);
  e.judgement = {{"live", figures_of({found.live})}, {"final", figures_of({found.final})}};
  e.truth_noise = found.live.noise;
  print(json ? to_json(e) : to_table(e));
}

void eval_many(const std::vector<std::string>& runs, bool json, RunReader* reader) {
  std::vector<NamedFigures> rows;
  std::vector<RunJudgement> all, normal, changed;
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
  print(json ? judgement_json(rows) + "\n" : judgement_table(rows));
}

}  // namespace

int eval_runs(const std::vector<std::string>& paths, const EvaluationOptions& options, bool json,
              const TrajectoryReading& truth_reading,
              const std::function<Trajectory(const std::string& path)>& read_truth) {
  const RunsAndTruth given = sort_out(paths);
  RunReader reader(given.truth, options.stated_noise, [&](const std::string& path) {
    Trajectory truth = read_truth(path);
    reread(truth_reading, &truth);
    return truth;
  });
  if (given.runs.size() == 1)
    eval_one(given.runs.front(), options, json, &reader);
  else
    eval_many(given.runs, json, &reader);
  return 0;
}

}  // namespace edgevo::app
