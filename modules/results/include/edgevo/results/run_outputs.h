#pragma once
// What `edgevo run` leaves in its output folder.
//
//   trajectory_tum.txt       final poses, one line for each frame that has one
//   trajectory_live_tum.txt  the poses as they were known when the frames came
//   trajectory_vehicle_tum.txt   final poses of the vehicle, where it is known how the camera sits on it
//   trajectory_kitti.txt     final poses as 3x4 matrices, one line for EVERY frame (see run_outputs_text.h)
//   frames.csv               one row for every frame; timing columns last
//   scale.csv                how the metres were found, where they were measured
//   edges.ply, edges.bt, edges.ot, grid.yaml + grid.pgm, grid.gridmap.gz   the map (occupancy)
//   keyframes.simplemap, playback.rawlog + playback_Images, scene.3Dscene   for MRPT's tools (mrpt_bridge)
//   report.html              all of it on one page (run_report.h)
//   summary.yaml             versions, parameters, scale, counts, timing, memory, and what could not be
//   written
// Room for the text files is held from the start, so that they are written even when images fill the disk.
// An output folder is created with its parents; results of an earlier run in it are overwritten. The text
// files but summary.yaml and the CPU times in frames.csv and report.html depend on the run alone: the same run
// gives the same bytes.
//
// Usage:
//   RunOutputs outputs(out, camera, options);      // throws when `out` cannot be a folder, or its disk is full
//   while (auto frame = source.next()) {
//     ...
//     if (!outputs.add_frame(*frame)) break;       // an image could not be written: end the run, keep what
//     there is
//   }
//   outputs.finish(run, info);                     // writes all; one failure does not keep the others from
//   being tried
#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/error.h"
#include "edgevo/core/image.h"
#include "edgevo/core/records.h"
#include "edgevo/mrpt_bridge/playback_writer.h"
#include "edgevo/report/run_info.h"
#include "edgevo/results/run_maps.h"
#include "edgevo/results/space_reserve.h"

namespace edgevo {

/// Time and memory of the process since `begin`.
struct ResourceUse {
  double wall_s = 0, cpu_s = 0, peak_memory_mb = 0;
};

class RunOutputs {
 public:
  /// Makes the folder and begins to count time. Throws InputError: not a folder, not writable, no
  /// room, occupancy parameters.
  RunOutputs(std::string folder, const Camera& camera, const MapParams& map);

  /// Writes the frame's image for playback.rawlog; or, if the image is on disk at `image_path` already, links
  /// to it. False once an image could not be written, and ever after: there is no point in going on, and
  /// finish() will tell why.
  [[nodiscard]] bool add_frame(const Frame& frame, const std::string& image_path = {});

  /// Writes everything else. When something could not be written, the rest is still tried, summary.yaml names
  /// what is missing, and then the first failure is thrown (InputError).
  void finish(const Run& run, const RunInfo& info);

 private:
  std::string report(const Run& run, const RunInfo& info, const MapReport& map) const;
  void attempt(const std::string& name, const std::function<void(const std::string& path)>& write);
  void note_failure(const std::string& name, const InputError& error);
  ResourceUse use_until_now() const;

  std::string folder_;
  Camera camera_;
  MapParams map_;
  std::chrono::steady_clock::time_point wall_begin_;
  double cpu_begin_s_ = 0;
  std::optional<SpaceReserve> text_reserve_, summary_reserve_;
  std::optional<PlaybackWriter> playback_;
  bool images_failed_ = false;
  std::optional<InputError> first_failure_;
  std::vector<std::string> not_written_;
};

}  // namespace edgevo
