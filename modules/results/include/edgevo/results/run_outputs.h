// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The output folder of a run, written by `edgevo run` and by any program that runs the odometry itself. Its
// files and their contents are listed in run_files() and src/exporters/exporters.cpp.
//
// A folder holds one run. An earlier run stays until the new one has results of its own: its files are set
// aside at the first frame and removed at the first pose. With keep_recovery_log() the results of a killed
// program can be recovered (recover_run.h).
//
// Space for the text files is reserved at the start, so that they are written even if images fill the disk.
// The files depend on the run alone (the same run gives the same bytes), except summary.yaml and the CPU
// times in frames.csv and report.html.
//
// Usage:
//   RunOutputs outputs(out, camera, map_params);  // throws: not a folder, not a run's folder, or a full disk
//   while (auto frame = source.next()) {
//     ...
//     if (!outputs.add_frame(*frame)) break;      // an image could not be written: end the run
//   }
//   outputs.finish(run, info);                    // writes all files that can be written
#include <memory>
#include <string>

#include "edgevo/core/camera.h"
#include "edgevo/core/error.h"
#include "edgevo/core/image.h"
#include "edgevo/core/records.h"
#include "edgevo/kept_map/map_file_writer.h"
#include "edgevo/map/map_log.h"
#include "edgevo/mcap_output/mcap_output.h"
#include "edgevo/report/run_info.h"
#include "edgevo/results/recovery_log.h"
#include "edgevo/results/run_maps.h"

namespace edgevo {

struct RecoveredRun;
struct RecoveryOptions;

/// Options of the output folder.
struct OutputOptions {
  /// Write into a folder that holds other files, or an interrupted run.
  bool force = false;
  /// Keep nothing of the run in memory: its results stay in the recovery log (end_unfinished()).
  bool forget = false;
  /// Write images and records in a thread of its own, for frames that must not wait for a disk: the files are
  /// up to date a moment later, and a failed image is reported a frame or more later.
  bool own_thread = false;
  /// Copy images that are on disk already, instead of linking to them.
  bool copy_images = false;
  /// What run.mcap holds; it needs keep_recovery_log().
  McapContent mcap = McapContent::kOff;
  /// Keep the map in map.db; it needs keep_recovery_log() and add_keyframe().
  bool keep_map = false;
  /// Put points of doubtful keyframes (KeyframeRecord::is_doubtful) into the maps, too.
  bool include_doubtful = false;
};

/// Writes the files of one run. For use by one thread.
class RunOutputs {
 public:
  /// Makes the folder and starts the clock. Throws InputError: not a folder, not writable, not enough space,
  /// a folder that holds something other than a run or that another run writes to, or invalid map parameters.
  RunOutputs(const std::string& folder, const Camera& camera, const MapParams& map,
             const OutputOptions& options = {});
  /// Removes the folder if it was made here and is still empty.
  ~RunOutputs();

  /// Keeps a recovery log of the events in `log` (OdometryOptions::map_log), from now on: call before the
  /// first frame. It is up to date after each add_record().
  void keep_recovery_log(const RecoveryHeader& header, const std::shared_ptr<MapLog>& log);

  /// Writes the frame's image for playback.rawlog, or links to `image_path` if the image is on disk already.
  /// A frame without an image (a skipped one) gets none. Returns false from the first image on that cannot be
  /// written: end the run, finish() throws the reason.
  [[nodiscard]] bool add_frame(const Frame& frame, const std::string& image_path = {});

  /// With a recovery log: appends the events so far to it, and the record of the frame to
  /// trajectory_live_tum.txt and frames.csv. Call after add_frame().
  void add_record(const FrameRecord& record);

  /// Writes the view of a frame to run.mcap, if that has images. Call after add_record(), where
  /// wants_views().
  void add_view(Timestamp time, const FrameView& view);
  /// Whether add_view() uses what it is given.
  bool wants_views() const;

  /// Adds a keyframe to map.db, if that is kept. From any thread, from the second frame on until finish().
  void add_keyframe(const StoredKeyframe& keyframe);

  /// Writes all other files. If one cannot be written, the rest still are, summary.yaml names what is
  /// missing, and the first failure is thrown at the end (InputError).
  void finish(const Run& run, const RunInfo& info) { finish(run, info, false); }
  /// Ends a run that was forgotten: the recovery log is complete, and recover_run() writes all files from it.
  /// Throws InputError if the log has ended for lack of space.
  void end_unfinished();
  /// After finish(): why the voxels of the map are coarser than intended; empty where they are not.
  const std::string& map_note() const;
  /// After finish(): McapOutput::note(); empty without run.mcap.
  const std::string& mcap_note() const;

  /// Folder with the files of an earlier run, which are kept because this run has no pose; empty: none.
  std::string earlier_run() const;

 private:
  friend RecoveredRun recover_run(const std::string& folder, const RecoveryOptions& options);
  void finish(const Run& run, const RunInfo& info, bool keep_log);
  /// Takes over the folder of an interrupted run, with images of the frames up to `last_frame`.
  void adopt(int last_frame);
  /// Takes over run.mcap, written up to its end; or null, and why there is none.
  void adopt(std::unique_ptr<McapOutput> mcap, const std::optional<InputError>& failure);
  /// Takes over map.db, if the run has kept it.
  void adopt_map();

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
