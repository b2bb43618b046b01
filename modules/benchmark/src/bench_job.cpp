// SPDX-License-Identifier: BSD-3-Clause
#include "bench_job.h"

#include <filesystem>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/core/output_file.h"
#include "edgevo/detectors/all_detectors.h"
#include "edgevo/evaluation/evaluate.h"
#include "edgevo/frame_evaluation/frame_figures.h"
#include "edgevo/results/run_text.h"
#include "edgevo/run_loop/run_odometry.h"
#include "file_lock.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTrajectory = "trajectory_tum.txt";

std::string in_folder(const BenchJob& job, const char* name) {
  return (fs::path(job.folder) / name).string();
}

VisitParams fields_of(Trial* trial) {
  return [trial](ParamVisitor& v) { trial->visit(v); };
}

// A trajectory that cannot be compared is also a result, with the reason in its note.
void evaluate_run(const BenchJob& job, const Run& run, const std::string& truth_text, Trial* trial) {
  if (truth_text.empty()) {
    trial->note = "no ground truth";
    return;
  }
  const Trajectory truth = parse_trajectory(truth_text, "ground truth of " + job.folder);
  if (trial->completion_percent == 0) {
    trial->note = "no frame has a pose";
    return;
  }
  add_frame_figures(figures_of({evaluate_frames_of(run, truth).live}), trial);
  try {
    add_errors(evaluate(read_trajectory(in_folder(job, kTrajectory)), truth, {}), trial);
  } catch (const InputError& e) {
    trial->note = e.what();
  }
}

// For `edgevo compare`: one file for all seeds of a variant.
void keep_ground_truth(const BenchJob& job, const std::string& truth_text) {
  if (!truth_text.empty())
    write_file((fs::path(job.folder).parent_path() / "groundtruth_tum.txt").string(), truth_text);
}

void begin_folder(const BenchJob& job) {
  std::error_code ignored;
  for (const char* name :
       {"job.yaml", "failure.txt"})  // the job counts as unfinished until it finishes again
    fs::remove(in_folder(job, name), ignored);
}

// Atomic, even if the process is killed.
void write_whole(const std::string& path, const std::string& text) {
  write_file(path + ".part", text);
  fs::rename(path + ".part", path);
}

RunResult run_source(const BenchJob& job, const BenchInput& input, ImageSource& source,
                     const BenchHost& host) {
  RunLoopOptions options;
  options.odometry.seed = job.seed;
  options.odometry.detectors = all_edge_detectors();
  options.stop = host.stop;
  const ProgressLine progress = host.progress(job.title(), source.size());
  const RunParams params = input.params(job.variant, job.edges);
  options.past.scale = params.scale;
  options.past.places = params.places;
  return run_odometry(source, params.odometry, options, [&, done = 0](const ProcessedFrame&) mutable {
    progress(++done);
    return true;
  });
}

std::optional<Trial> run_in_folder(const BenchJob& job, BenchInput& input, const BenchHost& host) {
  const std::unique_ptr<ImageSource> source = input.open(job.variant, job.seed, host);
  if (host.stop()) return std::nullopt;  // while a scene was rendered
  const RunResult result = run_source(job, input, *source, host);
  if (result.broken) std::rethrow_exception(result.broken);
  if (host.stop()) return std::nullopt;
  write_file(in_folder(job, kTrajectory), trajectory_tum(result.run, PoseKind::kFinal));
  write_file(in_folder(job, "trajectory_live_tum.txt"), trajectory_tum(result.run, PoseKind::kLive));
  write_file(in_folder(job, "frames.csv"), frames_csv(result.run));
  write_file(in_folder(job, "covariances.csv"), covariances_csv(result.run));
  Trial trial = trial_of(result.run, result.cpu_s);
  evaluate_run(job, result.run, input.ground_truth(), &trial);
  keep_ground_truth(job, input.ground_truth());
  write_file(in_folder(job, "result.yaml"), write_params(fields_of(&trial)));
  write_whole(in_folder(job, "job.yaml"), job.description);
  return trial;
}

}  // namespace

std::string BenchJob::title() const {
  return sequence + " " + variant.name + " seed " + std::to_string(seed);
}

BenchJob make_job(const BenchInput& input, const BenchVariant& variant, uint64_t seed, const std::string& out,
                  const std::string& version) {
  BenchJob job{input.sequence().name, variant, seed, {}, {}, {}};
  job.folder = (fs::path(out) / job.sequence / variant.name / ("seed" + std::to_string(seed))).string();
  job.description = "edgevo: \"" + version + "\"\nvariant: " + variant.name +
                    "\nseed: " + std::to_string(seed) + '\n' + input.description(variant);
  return job;
}

std::optional<Trial> finished_trial(const BenchJob& job) {
  const std::string path = in_folder(job, "job.yaml"), result = in_folder(job, "result.yaml");
  const std::string remedy = "remove " + job.folder + " to run the job again";
  std::error_code ignored;
  if (!fs::exists(path, ignored) || read_file(path, remedy) != job.description) return std::nullopt;
  Trial trial;
  read_params(read_file(result, remedy), result, fields_of(&trial));
  return trial;
}

std::string failure_of(const BenchJob& job) {
  const std::string path = in_folder(job, "failure.txt");
  std::error_code ignored;
  if (!fs::exists(path, ignored)) return "";
  const std::string text = read_file(path, "remove it");
  return text.substr(0, text.find('\n'));
}

std::optional<Trial> run_job(const BenchJob& job, BenchInput& input, const BenchHost& host) {
  make_output_folder(job.folder);
  const FileLock lock(job.folder);  // a process left behind by its engine may still be running it
  if (std::optional<Trial> trial = finished_trial(job)) return trial;
  begin_folder(job);
  try {
    return run_in_folder(job, input, host);
  } catch (const InputError& e) {
    write_whole(in_folder(job, "failure.txt"), std::string(e.what()) + '\n');
    throw;
  }
}

}  // namespace edgevo
