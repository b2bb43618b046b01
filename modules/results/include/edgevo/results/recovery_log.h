// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The recovery log: what a run has found so far, on disk while it runs, so that a killed program loses none
// of it.
//
// `unfinished_run.bin` in the run's folder holds a header, each frame as it was tracked and each keyframe as
// it left the window. Every record has a checksum, so the file may end anywhere. It is removed once the run's
// files are written. The bytes are specific to this machine and this version of the program. Cost: about 500
// bytes a frame and 40 bytes a map point; all keyframes again whenever the camera is corrected. Keyframes
// that are still in the window are in `unfinished_window.bin`, which is replaced as a whole after each
// keyframe. Neither file holds edge lines.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/live_keyframes.h"
#include "edgevo/core/records.h"
#include "edgevo/core/vehicle_track.h"
#include "edgevo/report/run_info.h"

namespace edgevo {

/// Name of the file with the keyframes of the window.
constexpr const char* kRunWindow = "unfinished_window.bin";
/// Name of the recovery log in the run's folder.
constexpr const char* kRecoveryLog = "unfinished_run.bin";

/// Everything known before the first frame that is needed to write a run's files.
struct RecoveryHeader {
  /// Description of the run, as in the run's files.
  RunInfo info;
  /// Source of the scale, in the syntax of --scale.
  std::string scale = "none";
  /// Vehicle track that the scale is measured by; may be empty.
  VehicleTrack track;
  /// Mount of the camera on the vehicle, if known.
  std::optional<SE3> T_vehicle_cam;
};

/// Writes the recovery log of one run. For use by one thread.
class RecoveryLog {
 public:
  /// Begins `folder`/unfinished_run.bin. Throws InputError if it cannot be made.
  RecoveryLog(const std::string& folder, const RecoveryHeader& header);
  ~RecoveryLog();

  /// Appends a frame as it was tracked. If it has no pose yet (a bootstrap may still find one), `frame` is
  /// read again when a later frame has a pose, so it must outlive the log. On a full disk the log ends and is
  /// removed; the run goes on.
  void add_frame(const FrameRecord& frame);
  /// Appends keyframes that have left the window: those after the first marginalised() of them, or all of
  /// them after a correction of the camera (another revision).
  void add_keyframes(const MarginalisedKeyframes& keyframes);
  /// Replaces the stored keyframes of the window. Does nothing if their revision is not that of the
  /// marginalised keyframes written so far.
  void add_window(const ActiveKeyframes& window);
  /// Appends the current result of self-calibration if it has changed.
  void add_camera(const CameraRefinement& camera);

  /// Number of keyframes written since the last revision.
  size_t marginalised() const;
  /// MarginalisedKeyframes::revision of the keyframes written.
  int revision() const;
  /// ActiveKeyframes::version of the window written last; 0: none.
  int window() const;
  /// Whether the log ended before the run, for lack of space.
  bool is_broken() const;
  /// Removes the log, once the run's files are written.
  void remove();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The state of an interrupted run, as far as its recovery log goes.
struct InterruptedRun {
  /// Header written before the first frame.
  RecoveryHeader header;
  /// Frames with live poses and keyframes in the same world; no final poses yet.
  Run run;
  /// Number of keyframes, the last ones of `run`, that were still in the window.
  size_t active = 0;
  /// For each keyframe, the number of frames written before it left the window.
  std::vector<size_t> frames_before_keyframe;
  /// Whether self-calibration has corrected the camera.
  bool camera_was_corrected = false;
};

/// Reads the recovery log in `folder` up to its first incomplete record. Throws InputError: no such file, or
/// a header that is incomplete or of another version.
InterruptedRun read_recovery_log(const std::string& folder);

}  // namespace edgevo
