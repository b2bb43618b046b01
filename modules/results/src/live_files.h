#pragma once
// The files of a run that grow while it goes on: the journal, and for people trajectory_live_tum.txt and
// frames.csv, which the run writes again, with all that it knows, at its end.
#include <string>

#include "edgevo/odometry/odometry.h"
#include "edgevo/results/run_journal.h"
#include "growing_file.h"

namespace edgevo {

class LiveFiles {
 public:
  /// Throws InputError when the journal cannot be begun.
  LiveFiles(const std::string& folder, const JournalHeader& header);

  /// One frame, the keyframes that have settled by then, and those of the window.
  void add(const FrameRecord& frame, const Odometry& odometry);

  /// There was no room for the journal any more.
  bool is_broken() const { return journal_.is_broken(); }

 private:
  void add_settled(const Odometry& odometry);

  RunJournal journal_;
  GrowingFile trajectory_, frames_;
};

}  // namespace edgevo
