// SPDX-License-Identifier: BSD-3-Clause
#include "map_records.h"

#include <cmath>
#include <utility>

namespace edgevo {
namespace {

KeyframeRecord to_record(const Keyframe& k, int segment) {
  KeyframeRecord record;
  record.frame_index = k.frame_index;
  record.time = k.time;
  record.segment = segment;
  record.T_world_cam = k.T_cam_world.inverse();
  record.points.reserve(k.points.size());
  const ImageView<uint8_t> gray = k.pyramid->finest().gray.view();
  for (const MapPoint& p : k.points) {
    EdgePoint e;
    e.px = p.px.cast<float>();
    e.normal = p.normal.cast<float>();
    e.idepth = float(p.idepth);
    e.idepth_sigma = float(p.idepth_sigma);
    e.observations = int(p.observations.size());
    e.gray = gray.at(int(std::lround(e.px.x())), int(std::lround(e.px.y())));
    record.points.push_back(e);
  }
  return record;
}

void revise_record(const RevisedKeyframe& r, KeyframeRecord* k) {
  k->T_world_cam = r.T_cam_world.inverse();
  for (size_t i = 0; i < k->points.size(); ++i) {
    EdgePoint& p = k->points[i];
    p.px = r.points[i].px.cast<float>();
    // Not by the ratio of the two depths: a point that moves to infinity does not become more certain.
    p.idepth_sigma /= float(r.length_ratio);
    p.idepth = float(r.points[i].idepth);
  }
}

}  // namespace

void MapRecords::note_times(int frame_index, const StageTimes& times) {
  const std::lock_guard<std::mutex> lock(mutex_);
  all_.times[frame_index] = times;
}

void MapRecords::note_window(const std::deque<Keyframe>& keyframes, int segment) {
  std::vector<KeyframeRecord> records;
  for (const Keyframe& k : keyframes) records.push_back(to_record(k, segment));
  const std::lock_guard<std::mutex> lock(mutex_);
  window_.revision = all_.revision;
  ++window_.version;
  window_.keyframes = std::move(records);
}

void MapRecords::add_marginalised(const std::vector<Keyframe>& keyframes, int segment) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const Keyframe& k : keyframes) {
    all_.keyframes[k.id] = to_record(k, segment);
    marginalised_.push_back(k.id);
  }
}

void MapRecords::set_lines(std::vector<HostedLines> hosted) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (HostedLines& h : hosted) all_.keyframes.at(h.keyframe_id).lines = std::move(h.lines);
}

void MapRecords::revise(const std::vector<RevisedKeyframe>& keyframes) {
  if (keyframes.empty()) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  ++all_.revision;
  for (const RevisedKeyframe& r : keyframes) {
    all_.length_ratio[r.id].emplace_back(all_.revision, r.length_ratio);
    const auto known = all_.keyframes.find(r.id);
    // A keyframe that is still in the window is recorded with its new values when it leaves.
    if (known != all_.keyframes.end()) revise_record(r, &known->second);
  }
}

int MapRecords::revision() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return all_.revision;
}

MarginalisedKeyframes MapRecords::marginalised(size_t first) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  MarginalisedKeyframes marginalised;
  marginalised.revision = all_.revision;
  for (size_t i = first; i < marginalised_.size(); ++i)
    marginalised.keyframes.push_back(all_.keyframes.at(marginalised_[i]));
  return marginalised;
}

std::optional<ActiveKeyframes> MapRecords::active(int version) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (window_.version == version) return std::nullopt;
  return window_;
}

MapRecords::Everything MapRecords::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  marginalised_.clear();
  return std::exchange(all_, {});
}

double MapRecords::Everything::length_ratio_since(int keyframe_id, int since) const {
  const auto known = length_ratio.find(keyframe_id);
  double ratio = 1;
  if (known != length_ratio.end())
    for (const auto& [number, value] : known->second)
      if (number > since) ratio *= value;
  return ratio;
}

}  // namespace edgevo
