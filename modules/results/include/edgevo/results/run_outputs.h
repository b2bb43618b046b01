#pragma once
// What a run leaves in its output folder, written by `edgevo run` and by any program that drives the odometry
// itself. Which files those are, and what they hold: run_files() and src/exporters/exporters.cpp.
//
// A folder holds one run. An earlier one stays until the new one has something to keep: its files are put
// aside at the first frame and go at the first pose. With keep_journal() a program that is killed loses
// nothing that it had: cut_off_run.h.
//
// Room for the text files is held from the start, so that they are written even when images fill the disk.
// The text files but summary.yaml and the CPU times in frames.csv and report.html depend on the run alone:
// the same run gives the same bytes.
//
// Usage:
//   RunOutputs outputs(out, camera, map_params);  // throws: no folder, somebody else's, or a full disk
//   while (auto frame = source.next()) {
//     ...
//     if (!outputs.add_frame(*frame)) break;      // an image could not be written: end the run
//   }
//   outputs.finish(run, info);                    // writes all, as far as it can be written
#include <memory>
#include <string>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/records.h"
#include "edgevo/odometry/odometry.h"
#include "edgevo/report/run_info.h"
#include "edgevo/results/run_journal.h"
#include "edgevo/results/run_maps.h"

namespace edgevo {

/// What may be chosen about the output folder.
struct OutputOptions {
  bool force = false;        ///< write into a folder that holds something else, or a run that was cut off
  bool copy_images = false;  ///< images that are on disk already are copied, not linked to
};

/// The files of one run. One thread.
class RunOutputs {
 public:
  /// Makes the folder and begins to count time. Throws InputError: not a folder, not writable, no room, the
  /// folder holds something else than a run or is being written, occupancy parameters.
  RunOutputs(const std::string& folder, const Camera& camera, const MapParams& map,
             const OutputOptions& options = {});
  /// Takes the folder away again if it was made here and nothing came into it.
  ~RunOutputs();

  /// From the first frame on, what add_record() is given is on disk at once. Before the first frame.
  void keep_journal(const JournalHeader& header);

  /// Writes the frame's image for playback.rawlog; or, if the image is on disk at `image_path` already, links
  /// to it. A frame without an image (one that was left out) has none there. False once an image could not be
  /// written, and ever after: there is no point in going on, and finish() will tell why.
  [[nodiscard]] bool add_frame(const Frame& frame, const std::string& image_path = {});

  /// What the odometry found for the frame, and all that has settled by then: into the journal, if there is
  /// one, and into trajectory_live_tum.txt and frames.csv as far as they are known. `record` must stay where
  /// it is until finish(), as the odometry's do. After add_frame().
  void add_record(const FrameRecord& record, const Odometry& odometry);

  /// Writes everything else. When something could not be written, the rest is still tried, summary.yaml names
  /// what is missing, and then the first failure is thrown (InputError).
  void finish(const Run& run, const RunInfo& info);

  /// Where the files of an earlier run lie, which this one, without any pose, does not replace; empty:
  /// nowhere.
  std::string earlier_run() const;

 private:
  friend Run finish_cut_off_run(const std::string& folder);
  /// The folder is that of a run that was cut off, with images of the frames up to `last_frame`.
  void adopt(int last_frame);

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
