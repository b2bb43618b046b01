#pragma once
// What a run leaves in its output folder, written by `edgevo run` and by any program that drives the odometry
// itself. Which files those are, and what they hold: run_files() and src/exporters/exporters.cpp.
//
// Room for the text files is held from the start, so that they are written even when images fill the disk.
// The text files but summary.yaml and the CPU times in frames.csv and report.html depend on the run alone:
// the same run gives the same bytes.
//
// Usage:
//   RunOutputs outputs(out, camera, map_params);  // throws: no folder, or a full disk
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
#include "edgevo/report/run_info.h"
#include "edgevo/results/run_maps.h"

namespace edgevo {

class RunOutputs {
 public:
  /// Makes the folder and begins to count time. Throws InputError: not a folder, not writable, no room,
  /// occupancy parameters.
  RunOutputs(const std::string& folder, const Camera& camera, const MapParams& map);
  ~RunOutputs();

  /// Writes the frame's image for playback.rawlog; or, if the image is on disk at `image_path` already, links
  /// to it. False once an image could not be written, and ever after: there is no point in going on, and
  /// finish() will tell why.
  [[nodiscard]] bool add_frame(const Frame& frame, const std::string& image_path = {});

  /// Writes everything else. When something could not be written, the rest is still tried, summary.yaml names
  /// what is missing, and then the first failure is thrown (InputError).
  void finish(const Run& run, const RunInfo& info);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
