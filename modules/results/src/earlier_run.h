// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Files that an earlier run has left in the output folder of a new one. They are kept until the new run has
// results: from its first frame to its first pose they are in the subfolder `earlier_run`.
#include <string>
#include <vector>

namespace edgevo {

/// Name of the subfolder of a run's folder.
constexpr const char* kEarlierRun = "earlier_run";

/// The files of the earlier run.
class EarlierRun {
 public:
  /// Inspects the folder (which need not exist) without changing it. Throws InputError if it holds something
  /// other than a run, or an interrupted run, unless `force` is set; and if another run is writing to it.
  EarlierRun(std::string folder, bool force);

  /// Moves the files of the earlier run to the subfolder, at the start of the new run. Files that no run
  /// writes stay where they are. Throws InputError.
  void set_aside();
  /// Removes the earlier run, once the new one has results.
  void remove();
  /// Whether the earlier run is in the subfolder.
  bool is_set_aside() const;

 private:
  std::vector<std::string> files_of_runs() const;

  std::string folder_;
};

}  // namespace edgevo
