#include "live_files.h"

#include <filesystem>

#include "edgevo/results/run_text.h"

namespace edgevo {
namespace {

std::string in(const std::string& folder, const char* file) {
  return (std::filesystem::path(folder) / file).string();
}

// What cannot be written here is tried again at the end, and told then.
void begin(GrowingFile* file, const std::string& path, const std::string& header) {
  if (file->open(path) && !file->append(header)) file->close();
}

void extend(GrowingFile* file, const std::string& line) {
  if (!file->append(line)) file->close();
}

}  // namespace

LiveFiles::LiveFiles(const std::string& folder, const JournalHeader& header) : journal_(folder, header) {
  const Run nothing;
  begin(&trajectory_, in(folder, "trajectory_live_tum.txt"), trajectory_tum(nothing, PoseKind::kLive));
  begin(&frames_, in(folder, "frames.csv"), frames_csv(nothing));
}

void LiveFiles::add(const FrameRecord& frame, const Odometry& odometry) {
  journal_.add_frame(frame);
  add_settled(odometry);
  extend(&frames_, frames_csv_row(frame, {}));
  if (frame.T_world_cam_live && frame.T_world_cam_live->is_finite())
    extend(&trajectory_, tum_line(frame.time, *frame.T_world_cam_live));
}

void LiveFiles::add_settled(const Odometry& odometry) {
  if (journal_.is_broken()) return;
  SettledKeyframes settled = odometry.settled_keyframes(journal_.settled());
  if (settled.revision != journal_.revision()) settled = odometry.settled_keyframes();
  journal_.add_keyframes(settled);
  if (const auto window = odometry.unsettled_keyframes(journal_.window())) journal_.add_window(*window);
  if (const auto& reference = odometry.newest_pose().reference) journal_.add_camera(reference->camera);
}

}  // namespace edgevo
