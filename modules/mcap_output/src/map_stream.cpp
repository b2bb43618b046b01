// SPDX-License-Identifier: BSD-3-Clause
#include "map_stream.h"

namespace edgevo {
namespace {

// A second: together 15 kB of the 33 that two megabytes a minute are, as compressed; poses take 10, and what
// is written at the end 4.
constexpr double kPointsPerSecond = 500, kPiecesPerSecond = 400, kSamplesPerSecond = 500;
// Keyframes whose lines may still come: twelve more keyframes make them final (edge_map/edge_mapper.h).
constexpr size_t kHosts = 100;

}  // namespace

MapStream::MapStream(TopicFile* file, const LiveFrames* frames, const Pinhole& pinhole,
                     const PointFilter& filter)
    : file_(*file),
      frames_(*frames),
      pinhole_(pinhole),
      filter_(filter),
      points_(kPointsPerSecond),
      pieces_(kPiecesPerSecond),
      samples_(kSamplesPerSecond) {}

void MapStream::set_now(Timestamp now) {
  now_ = now;
  for (Allowance* allowance : {&points_, &pieces_, &samples_}) allowance->advance(now);
}

ShapeView MapStream::view_of(int keyframe_id, const Host& host) const {
  const Sim3 T_map_segment = frames_.T_map_segment(host.segment, keyframe_id);
  return {pinhole_, T_map_segment * Sim3{1, host.T_segment_cam}};
}

void MapStream::add(const KeyframeMarginalised& marginalised) {
  const KeyframeRecord& keyframe = *marginalised.keyframe;
  if (keyframe.is_doubtful) return;
  const Host& host = hosts_[marginalised.id] = {keyframe.segment, keyframe.T_world_cam};
  const ShapeView view = view_of(marginalised.id, host);
  const std::vector<RosPoint> cloud =
      cloud_of(keyframe, view, filter_, points_.take(points_kept(keyframe, filter_)));
  if (!cloud.empty()) file_.write(Topic::kPoints, now_, cloud_message({now_, kMapFrame}, cloud));
  if (hosts_.size() > kHosts) hosts_.erase(hosts_.begin());
}

void MapStream::apply(const MapMoved& moved) {
  for (const KeyframeMove& move : moved.keyframes)
    if (const auto host = hosts_.find(move.id); host != hosts_.end())
      host->second.T_segment_cam = moved.T_cam_map(move).inverse();
}

void MapStream::add(const LinesFinished& lines) {
  const auto host = hosts_.find(lines.keyframe_id);
  if (host == hosts_.end()) return;
  const ShapeView view = view_of(lines.keyframe_id, host->second);
  hosts_.erase(host);
  size_t vertices = 0;
  for (const EdgeLine& line : lines.lines) vertices += line.vertices.size();
  const std::vector<Eigen::Vector3d> all = pieces_of(lines.lines, view, vertices);
  const size_t pieces = pieces_.take(all.size() / 2);
  if (pieces > 0)
    file_.write(
        Topic::kEdges, now_,
        lines_message({now_, kMapFrame},
                      {{lines.keyframe_id, {all.begin(), all.begin() + std::ptrdiff_t(2 * pieces)}}}, false));
  const std::vector<RosPoint> samples = samples_of(lines.lines, view, samples_.take(vertices));
  if (!samples.empty()) file_.write(Topic::kEdgePoints, now_, cloud_message({now_, kMapFrame}, samples));
}

}  // namespace edgevo
