// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/finished_run.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "edgevo/core/block_yaml.h"
#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRemedy = "give the folder of a finished run";

bool holds(const fs::path& folder, const char* file) {
  std::error_code ignored;
  return fs::is_regular_file(folder / file, ignored);
}

bool is_run(const fs::path& folder) {
  return holds(folder, "trajectory_tum.txt") || holds(folder, "frames.csv");
}

void add_runs(const fs::path& folder, std::vector<std::string>* found) {
  if (is_run(folder)) {
    found->push_back(folder.string());
    return;
  }
  std::vector<fs::path> below;
  std::error_code ignored;  // an unreadable folder counts as empty
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.is_directory(ignored) && !entry.is_symlink(ignored)) below.push_back(entry.path());
  std::sort(below.begin(), below.end());
  for (const fs::path& one : below) add_runs(one, found);
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
  return fields;
}

// Reads frames.csv by column names.
class FrameTable {
 public:
  explicit FrameTable(const std::string& path) : path_(path), lines_(read_file(path, kRemedy)) {
    std::string header;
    std::getline(lines_, header);
    names_ = split(header);
  }
  // Reads the next row; false after the last one.
  bool next() {
    std::string line;
    if (!std::getline(lines_, line)) return false;
    ++row_;
    fields_ = split(line);
    if (fields_.size() <= column("keyframe"))
      throw InputError(path_ + ":" + std::to_string(row_ + 1), "the line is incomplete", kRemedy);
    return true;
  }
  const std::string& text(const char* name) const { return fields_[column(name)]; }
  int integer(const char* name) const { return std::atoi(text(name).c_str()); }
  // Time of all stages in this row, milliseconds; a stage that did not run is empty.
  double stages_ms() const {
    double sum = 0;
    for (size_t i = 0; i < std::min(names_.size(), fields_.size()); ++i)
      if (names_[i].rfind("ms_", 0) == 0) sum += std::atof(fields_[i].c_str());
    return sum;
  }

 private:
  size_t column(const char* name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) throw InputError(path_, std::string("has no column ") + name, kRemedy);
    return size_t(found - names_.begin());
  }

  std::string path_;
  std::istringstream lines_;
  std::vector<std::string> names_, fields_;
  int row_ = 0;
};

void read_frames(FinishedRun* run) {
  FrameTable table((fs::path(run->folder) / "frames.csv").string());
  double ms = 0;
  bool begun = false;
  while (table.next()) {
    const int segment = table.integer("segment");
    begun |= segment >= 0;
    run->lost += begun && segment < 0;
    run->keyframes += table.integer("keyframe");
    run->segments = std::max(run->segments, segment + 1);
    ms += table.stages_ms();
    ++run->frames;
  }
  if (run->frames == 0) throw InputError(run->folder + "/frames.csv", "lists no frames", kRemedy);
  run->cpu_ms = ms / run->frames;
}

// The YAML text with all lines outside `group` blanked, since parse_block_yaml may refuse other groups.
std::string group_of(const std::string& yaml, const std::string& group) {
  std::istringstream lines(yaml);
  std::string kept;
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line[0] != ' ') inside = line == group + ":";
    kept += (inside ? line : "") + '\n';
  }
  return kept;
}

// Reads source and ground truth as `edgevo run` noted them.
void read_summary(FinishedRun* run) {
  const std::string path = (fs::path(run->folder) / "summary.yaml").string();
  for (const YamlEntry& entry : parse_block_yaml(group_of(read_file(path, kRemedy), "source"), path)) {
    if (entry.key == "source.path") run->source = entry.value;
    if (entry.key == "source.ground_truth") run->ground_truth = entry.value;
  }
  if (holds(run->folder, "report.html")) run->report = (fs::path(run->folder) / "report.html").string();
}

// Reads a job of a benchmark: OUT/SEQUENCE/VARIANT/seedN, with the ground truth in the folder of the variant.
void read_job(FinishedRun* run) {
  const fs::path variant = fs::absolute(run->folder).lexically_normal().parent_path();
  run->source = variant.parent_path().filename().string();
  if (holds(variant, "groundtruth_tum.txt")) run->ground_truth = (variant / "groundtruth_tum.txt").string();
}

void read_origin(FinishedRun* run) {
  if (holds(run->folder, "summary.yaml")) return read_summary(run);
  if (holds(run->folder, "job.yaml")) return read_job(run);
  throw InputError(run->folder, "is incomplete: there is neither summary.yaml nor job.yaml", kRemedy);
}

void forget_missing_truth(FinishedRun* run) {
  std::error_code ignored;
  if (!fs::is_regular_file(run->ground_truth, ignored)) run->ground_truth.clear();
}

bool has_poses(const std::string& tum) {
  std::istringstream lines(tum);
  for (std::string line; std::getline(lines, line);)
    if (!line.empty() && line[0] != '#') return true;
  return false;
}

void read_poses(FinishedRun* run) {
  const std::string path = (fs::path(run->folder) / "trajectory_tum.txt").string(),
                    text = read_file(path, kRemedy);
  if (has_poses(text)) run->trajectory = parse_trajectory(text, path);
  run->trajectory.path = path;
}

}  // namespace

std::vector<std::string> find_runs(const std::string& path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored))
    throw InputError(path, "is not a folder", "give the folder of a run, or one that holds runs");
  std::vector<std::string> found;
  add_runs(path, &found);
  if (found.empty())
    throw InputError(path, "holds no results of a run",
                     "give the folder that was -o of `edgevo run` or `edgevo bench`");
  return found;
}

FinishedRun read_finished_run(const std::string& folder) {
  FinishedRun run;
  run.folder = folder;
  try {
    read_origin(&run);
    forget_missing_truth(&run);
    read_frames(&run);
    read_poses(&run);
  } catch (const InputError& e) {
    run.problem = e.what();
  }
  return run;
}

}  // namespace edgevo
