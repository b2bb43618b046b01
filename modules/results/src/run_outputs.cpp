#include "edgevo/results/run_outputs.h"

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>

#include "edgevo/core/output_file.h"
#include "edgevo/mrpt_bridge/scene_writer.h"
#include "edgevo/mrpt_bridge/simplemap_writer.h"
#include "edgevo/occupancy/edge_ply.h"
#include "edgevo/report/run_report.h"
#include "edgevo/results/run_text.h"
#include "summary.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

// Three trajectories and frames.csv take about 600 bytes a frame: 10 000 frames.
constexpr size_t kTextBytes = 6 << 20, kSummaryBytes = 64 << 10;

double seconds(const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); }

rusage usage() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  return use;
}

double cpu_seconds(const rusage& use) { return seconds(use.ru_utime) + seconds(use.ru_stime); }

// The first line: libraries add call stacks below it.
std::string first_line(const std::string& text) { return text.substr(0, text.find_first_of("\r\n")); }

}  // namespace

RunOutputs::RunOutputs(std::string folder, const Camera& camera, const MapParams& map)
    : folder_(std::move(folder)),
      camera_(camera),
      map_(map),
      wall_begin_(std::chrono::steady_clock::now()),
      cpu_begin_s_(cpu_seconds(usage())) {
  map_.check();
  make_output_folder(folder_);
  text_reserve_.emplace(folder_, kTextBytes);
  summary_reserve_.emplace(folder_, kSummaryBytes);
  playback_.emplace(folder_, camera);
}

bool RunOutputs::add_frame(const Frame& frame, const std::string& image_path) {
  if (images_failed_) return false;
  try {
    if (image_path.empty())
      playback_->add_frame(frame);
    else
      playback_->add_frame_link(frame.index, image_path);
  } catch (const InputError& e) {
    images_failed_ = true;
    note_failure("playback_Images", e);
  }
  return !images_failed_;
}

void RunOutputs::finish(const Run& run, const RunInfo& info) {
  SummaryInput summary{run, info, use_until_now(), {}, {}, {}};
  const PointFilter& filter = map_.occupancy.points;
  text_reserve_.reset();
  attempt("trajectory_tum.txt",
          [&](const auto& path) { write_file(path, trajectory_tum(run, PoseKind::kFinal)); });
  attempt("trajectory_live_tum.txt",
          [&](const auto& path) { write_file(path, trajectory_tum(run, PoseKind::kLive)); });
  if (run.T_vehicle_cam)
    attempt("trajectory_vehicle_tum.txt", [&](const auto& path) { write_file(path, trajectory_vehicle_tum(run)); });
  attempt("trajectory_kitti.txt", [&](const auto& path) { write_file(path, trajectory_kitti(run)); });
  attempt("frames.csv", [&](const auto& path) { write_file(path, frames_csv(run)); });
  if (!run.scale.frames.empty()) attempt("scale.csv", [&](const auto& path) { write_file(path, scale_csv(run)); });
  attempt("edges.ply", [&](const auto& path) { write_edge_ply(run, filter, path); });
  summary.map = write_map_files(run, map_, [&](const auto& name, const auto& write) { attempt(name, write); });
  attempt("keyframes.simplemap", [&](const auto& path) { write_simplemap(run, filter, path); });
  attempt("scene.3Dscene", [&](const auto& path) { write_scene(run, filter, path); });
  attempt("playback.rawlog", [&](const auto&) { playback_->finish(run, filter); });
  attempt("report.html", [&](const auto& path) { write_file(path, report(run, info, summary.map)); });
  summary.use_with_outputs = use_until_now();
  summary.not_written = not_written_;
  summary_reserve_.reset();
  attempt("summary.yaml", [&](const auto& path) { write_file(path, summary_yaml(summary)); });
  if (first_failure_) throw *first_failure_;
}

std::string RunOutputs::report(const Run& run, const RunInfo& info, const MapReport& map) const {
  constexpr int kPictures = 6;
  const auto image_path = [&](int frame) { return playback_->image_path(frame); };
  const PointFilter& points = map_.occupancy.points;
  return report_html({run, info, points, draw_edge_pictures(run, camera_, points, image_path, kPictures), not_written_, map});
}

void RunOutputs::attempt(const std::string& name, const std::function<void(const std::string& path)>& write) {
  const std::string path = (fs::path(folder_) / name).string();
  try {
    write(path);
  } catch (const InputError& e) {
    note_failure(name, e);
  } catch (const std::exception& e) {
    note_failure(name, InputError(path, "cannot be written: " + first_line(e.what()), ""));
  }
}

void RunOutputs::note_failure(const std::string& name, const InputError& error) {
  not_written_.push_back(name);
  if (!first_failure_) first_failure_ = error;
}

ResourceUse RunOutputs::use_until_now() const {
  const rusage use = usage();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_begin_;
  return {wall.count(), cpu_seconds(use) - cpu_begin_s_, double(use.ru_maxrss) / 1024};
}

}  // namespace edgevo
