#include "earlier_run.h"

#include <algorithm>
#include <filesystem>

#include "edgevo/core/error.h"
#include "edgevo/files/output_folder.h"
#include "edgevo/results/run_files.h"
#include "edgevo/results/run_journal.h"
#include "growing_file.h"
#include "journal_format.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

// By which a run's folder is known; the third is there while a run begins or where one did not get far.
const std::vector<std::string> kMarks{"trajectory_live_tum.txt", kRunJournal, kEarlierRun};

void check_is_written_to_its_end(const std::string& folder, bool force) {
  std::error_code ignored;
  if (force || !fs::exists(journal_path(folder), ignored)) return;
  throw InputError(folder, "the run in it was cut off before its results were written",
                   "`edgevo finish " + folder + "` writes them; --force starts over");
}

void move(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error)
    throw InputError(from.string(), "of an earlier run cannot be moved: " + error.message(),
                     "give another -o");
}

}  // namespace

EarlierRun::EarlierRun(std::string folder, bool force) : folder_(std::move(folder)) {
  if (GrowingFile::is_growing(journal_path(folder_)))
    throw InputError(folder_, "another run is writing there", "wait for it, or give another -o");
  check_folder_is_ours(folder_, kMarks, force);
  check_is_written_to_its_end(folder_, force);
}

std::vector<std::string> EarlierRun::files_of_runs() const {
  std::vector<std::string> known = journal_files(), found;
  for (const RunFile& file : run_files()) known.push_back(file.name);
  for (const std::string& name : names_in(folder_))
    if (std::find(known.begin(), known.end(), name) != known.end()) found.push_back(name);
  return found;
}

void EarlierRun::set_aside() {
  const std::vector<std::string> files = files_of_runs();
  // A run that got no pose left that place in use: what lies there is worth more than what it left itself.
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
