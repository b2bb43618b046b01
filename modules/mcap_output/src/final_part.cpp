// SPDX-License-Identifier: BSD-3-Clause
#include "final_part.h"

#include <algorithm>

#include "edge_shapes.h"

namespace edgevo {
namespace {

// Pieces of lines a minute of the run: 0.15 MB.
constexpr double kPiecesPerMinute = 6000, kSecondsPerMinute = 60;
// A short run shows its map, too.
constexpr double kMinMinutes = 0.25;

// base_link as the live poses have it, in the axes of the map files: where up was found at the end, these
// differ from those of base_link at the start.
SE3 T_map_base(const Run& run, const LiveEnd& end, const SE3& T_world_cam) {
  return T_map_world(run) * T_world_cam * end.T_base_cam.inverse();
}

std::vector<std::pair<Timestamp, SE3>> path_of(const Run& run, const LiveEnd& end) {
  std::vector<std::pair<Timestamp, SE3>> path;
  for (const FrameRecord& frame : run.frames)
    if (frame.T_world_cam && frame.T_world_cam->is_finite())
      path.emplace_back(frame.time, T_map_base(run, end, *frame.T_world_cam));
  return path;
}

size_t pieces_allowed(const Run& run) {
  const double minutes = seconds_between(run.frames.front().time, run.frames.back().time) / kSecondsPerMinute;
  return size_t(kPiecesPerMinute * std::max(minutes, kMinMinutes));
}

// All lines, or of too many those of each keyframe in proportion.
std::vector<RosLines> lines_of(const Run& run) {
  std::vector<RosLines> all;
  size_t count = 0;
  for (size_t i = 0; i < run.keyframes.size(); ++i) {
    const KeyframeRecord& k = run.keyframes[i];
    const ShapeView view{run.pinhole, Sim3{1, T_map_world(run) * k.T_world_cam}};
    all.push_back({int(i), pieces_of(k.lines, view, SIZE_MAX / 2)});
    count += all.back().ends.size() / 2;
  }
  const double share = std::min(1.0, double(pieces_allowed(run)) / double(std::max<size_t>(count, 1)));
  for (RosLines& lines : all) lines.ends.resize(2 * size_t(share * double(lines.ends.size() / 2)));
  all.erase(std::remove_if(all.begin(), all.end(), [](const RosLines& l) { return l.ends.empty(); }),
            all.end());
  return all;
}

}  // namespace

std::optional<SE3> final_T_map_odom(const Run& run, const LiveEnd& end) {
  if (!end.T_odom_base) return std::nullopt;
  const auto last = std::find_if(run.frames.rbegin(), run.frames.rend(), [&](const FrameRecord& f) {
    return f.time == end.T_odom_base->first && f.T_world_cam && f.T_world_cam->is_finite();
  });
  if (last == run.frames.rend()) return std::nullopt;
  return T_map_base(run, end, *last->T_world_cam) * end.T_odom_base->second.inverse();
}

void write_final_part(const Run& run, const OccupancyGrid* grid, const LiveEnd& end, TopicFile* file) {
  if (run.frames.empty()) return;
  const RosHeader header{end.time, kMapFrame};
  file->write(Topic::kPath, end.time, path_message(header, path_of(run, end)));
  file->write(Topic::kEdges, end.time, lines_message(header, lines_of(run), true));
  if (grid) file->write(Topic::kGrid, end.time, grid_message(header, *grid));
}

}  // namespace edgevo
