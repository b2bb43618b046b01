// SPDX-License-Identifier: BSD-3-Clause
#include "earlier_run.h"

#include <algorithm>
#include <filesystem>

#include "edgevo/core/error.h"
#include "edgevo/files/output_folder.h"
#include "edgevo/kept_map/map_file_writer.h"
#include "edgevo/results/recovery_log.h"
#include "growing_file.h"
#include "recovery_format.h"
#include "run_files.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

// Files by which a run's folder is recognised. The third exists until a run has its first pose.
const std::vector<std::string> kMarks{"trajectory_live_tum.txt", kRecoveryLog, kEarlierRun};

void check_is_complete(const std::string& folder, bool force) {
  std::error_code ignored;
  if (force || !fs::exists(recovery_log_path(folder), ignored)) return;
  throw InputError(folder, "the run in it was interrupted before its results were written",
                   "`edgevo finish " + folder + "` writes them; --force starts over");
}

void move(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error)
    throw InputError(from.string(), "cannot be moved out of the way of the new run: " + error.message(),
                     "give another -o");
}

}  // namespace

EarlierRun::EarlierRun(std::string folder, bool force) : folder_(std::move(folder)) {
  if (GrowingFile::is_growing(recovery_log_path(folder_)))
    throw InputError(folder_, "another run is writing there", "wait for it, or give another -o");
  check_folder_is_ours(folder_, kMarks, force);
  check_is_complete(folder_, force);
}

std::vector<std::string> EarlierRun::files_of_runs() const {
  std::vector<std::string> known = recovery_files(), found;
  for (const RunFile& file : run_files()) known.push_back(file.name);
  for (const std::string& file : map_file_names()) known.push_back(file);
  for (const std::string& name : names_in(folder_))
    if (std::find(known.begin(), known.end(), name) != known.end()) found.push_back(name);
  return found;
}

void EarlierRun::set_aside() {
  const std::vector<std::string> files = files_of_runs();
  // Already in use if the last run had no pose: the run that is kept there is worth more than that last one.
  const bool in_use = is_set_aside();
  std::error_code ignored;
  const fs::path folder = folder_, aside = folder / kEarlierRun;
  if (!in_use && !files.empty()) fs::create_directory(aside, ignored);
  for (const std::string& file : files) {
    if (in_use)
      fs::remove_all(folder / file, ignored);
    else
      move(folder / file, aside / file);
  }
}

void EarlierRun::remove() {
  std::error_code ignored;
  fs::remove_all(fs::path(folder_) / kEarlierRun, ignored);
}

bool EarlierRun::is_set_aside() const {
  std::error_code ignored;
  return fs::exists(fs::path(folder_) / kEarlierRun, ignored);
}

}  // namespace edgevo
