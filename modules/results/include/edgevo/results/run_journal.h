#pragma once
// What a run has so far, on disk while it goes on: a program that is killed loses none of it.
//
// The file `unfinished_run.bin` in the run's folder holds a header, then each frame as it came and each
// keyframe as it left the window, one record after the other with its checksum, so that the end may be
// missing anywhere. It goes away when the run's files are written. Its bytes are those of this machine and
// this version of the program. Cost: a frame about 500 bytes, a keyframe 40 bytes a point; all keyframes once
// more when the camera is corrected. Keyframes still in the window lie in `unfinished_window.bin`, which is
// written anew after each keyframe, beside the old one, and takes its place. Lines of edges are in neither.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/live_keyframes.h"
#include "edgevo/core/records.h"
#include "edgevo/core/vehicle_track.h"
#include "edgevo/report/run_info.h"

namespace edgevo {

constexpr const char* kRunWindow = "unfinished_window.bin";  ///< of the keyframes of the window, beside it
constexpr const char* kRunJournal = "unfinished_run.bin";    ///< name of the file in the run's folder

/// All that is known before the first frame and needed to write a run's files.
struct JournalHeader {
  RunInfo info;                      ///< as for the run's files
  std::string scale = "none";        ///< as --scale gave it
  VehicleTrack track;                ///< that it is measured by; may be empty
  std::optional<SE3> T_vehicle_cam;  ///< mount of the camera, if it is known
};

/// Writes the journal of one run. One thread.
class RunJournal {
 public:
  /// Begins `folder`/unfinished_run.bin. Throws InputError when it cannot be made.
  RunJournal(const std::string& folder, const JournalHeader& header);
  ~RunJournal();

  /// A frame as it came. It may still get a pose (a bootstrap looks back): `frame` is looked at again until
  /// it has one, as long as frames go on without. No room: the journal ends there and goes away, the run does
  /// not.
  void add_frame(const FrameRecord& frame);
  /// Keyframes that have left the window: those behind the first settled() of them; after a correction of the
  /// camera (another revision) all.
  void add_keyframes(const SettledKeyframes& keyframes);
  /// The keyframes of the window as they stand, in place of those before. Left out where they are of another
  /// revision than the settled ones written so far.
  void add_window(const UnsettledKeyframes& window);
  /// What self-calibration says now; written where it changed.
  void add_camera(const CameraRefinement& camera);

  size_t settled() const;  ///< keyframes written since the last revision
  int revision() const;    ///< SettledKeyframes::revision of these
  int window() const;      ///< UnsettledKeyframes::version of the window written last; 0: none
  /// The journal has ended before the run.
  bool is_broken() const;
  /// The run's files are written: takes the journal away.
  void remove();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What a run that was cut off has left.
struct CutOffRun {
  JournalHeader header;  ///< as it was before the first frame
  Run run;               ///< frames with live poses, keyframes in the same world; no final poses yet
  size_t unsettled = 0;  ///< the last so many keyframes were still in the window
  std::vector<size_t> frames_before_keyframe;  ///< frames that had come when each keyframe left the window
  bool camera_was_corrected = false;           ///< self-calibration has changed the camera
};

/// Reads as far as the file is whole. Throws InputError: no such file, a header that is not whole or of
/// another version.
CutOffRun read_run_journal(const std::string& folder);

}  // namespace edgevo
