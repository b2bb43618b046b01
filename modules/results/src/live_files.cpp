// SPDX-License-Identifier: BSD-3-Clause
#include "live_files.h"

#include <filesystem>
#include <utility>

#include "edgevo/results/run_text.h"

namespace edgevo {
namespace {

std::string in(const std::string& folder, const char* file) {
  return (std::filesystem::path(folder) / file).string();
}

// Failures are ignored here: the file is written again at the end, and a failure is reported then.
void begin(GrowingFile* file, const std::string& path, const std::string& header) {
  if (file->open(path) && !file->append(header)) file->close();
}

void extend(GrowingFile* file, const std::string& line) {
  if (!file->append(line)) file->close();
}

}  // namespace

LiveFiles::LiveFiles(const std::string& folder, const RecoveryHeader& header, MapCursor events)
    : recovery_log_(folder, header), events_(std::move(events)) {
  const Run nothing;
  begin(&trajectory_, in(folder, "trajectory_live_tum.txt"), trajectory_tum(nothing, PoseKind::kLive));
  begin(&frames_, in(folder, "frames.csv"), frames_csv(nothing));
}

void LiveFiles::add(const FrameRecord& frame) {
  extend(&frames_, frames_csv_row(frame, {}));
  if (frame.T_world_cam_live && frame.T_world_cam_live->is_finite())
    extend(&trajectory_, tum_line(frame.time, *frame.T_world_cam_live));
}

// Without a recovery log, too: an event is kept in memory until it has been read.
void LiveFiles::write_events() {
  const auto events = events_.read();
  if (!recovery_log_.is_broken()) recovery_log_.add(events);
}

}  // namespace edgevo
