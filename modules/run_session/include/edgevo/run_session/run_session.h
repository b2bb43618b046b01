// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One run of the program: opens the source, tracks it, scales it and writes its folder, in the order in which
// each step can still fail without a loss. `edgevo run` is this with arguments.
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/target_pinhole.h"
#include "edgevo/datasets/open_source.h"
#include "edgevo/map/map_log.h"
#include "edgevo/results/run_outputs.h"
#include "edgevo/results/run_params.h"
#include "edgevo/run_loop/run_odometry.h"

namespace edgevo {

/// What to run, and how.
struct RunRequest {
  /// The source; kAutoCamera (calibration/auto_camera.h) as its camera file: found from the motion.
  SourceOptions source;
  /// Pinhole to work in; empty: that of the camera.
  TargetRequest target;
  /// Folder for the results.
  std::string out;
  /// Parameters by group.
  RunParams params;
  /// Sources of the scale, as --scale gives them.
  std::string scale = "none";
  /// Map that an earlier run has kept (map.db, or the folder of the run), whose frame and unit the run gets
  /// where its places are recognised; empty: none.
  std::string map;
  /// Whether that map gets what is new in the run, if the run was found in it.
  bool extend_map = false;
  /// File for a trace; empty: none.
  std::string trace;
  /// Seed of all random numbers.
  uint64_t seed = 1;
  /// Whether tracking and mapping have a thread each.
  bool realtime = false;
  /// Whether tracking gets the real-time priority of the system.
  bool prioritise = false;
  /// Whether to report errors only.
  bool quiet = false;
  /// What to do with an unusable frame.
  OnBadFrame on_bad_frame = OnBadFrame::kSkip;
  /// Pace of a realtime run.
  Pace pace;
  /// Options of the folder; own_thread is that of `realtime`.
  OutputOptions outputs;
  /// Program and arguments, for the summary.
  std::vector<std::string> command_line;
};

/// Shows the number of frames done; the display ends when the last copy is destroyed.
struct ProgressDisplay {
  /// Shows the number.
  std::function<void(int done)> update;
  /// Prints a line above it.
  std::function<void(const std::string& line)> say;
};

/// Shows a frame and waits while the view is paused. Returns false if the user wants the run to end.
using ShowFrame = std::function<bool(const ProcessedFrame&)>;

/// Services of the program that runs. Lines have no line end.
struct RunHost {
  /// From this call on, signals no longer end the program but are reported by `stop`.
  std::function<void()> listen_to_signals;
  /// Whether the user wants the run to end.
  std::function<bool()> stop;
  /// Prints a line of the results.
  std::function<void(const std::string& line)> print;
  /// Prints a line of notes, warnings or errors.
  std::function<void(const std::string& line)> warn;
  /// Starts a progress display: its title, and the number of frames if known.
  std::function<ProgressDisplay(const std::string& what, std::optional<int> total)> progress;
  /// Opens a window; returns nothing, and the reason in `why`, where it does not open. Empty: no window.
  std::function<ShowFrame(const std::optional<SE3>& T_vehicle_cam, std::shared_ptr<MapLog> log,
                          std::string* why)>
      open_window;
};

/// Runs. Returns false where most frames have no pose, or too many poses are doubtful, after a line that says
/// so. Throws InputError for bad input, or after the results are written what the source threw.
bool run_session(const RunRequest& request, const RunHost& host);

}  // namespace edgevo
