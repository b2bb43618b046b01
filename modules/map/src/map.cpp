// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/map.h"

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace edgevo {

KeyframeRecord make_record(const Keyframe& k, int segment) {
  KeyframeRecord record;
  record.frame_index = k.frame_index;
  record.time = k.time;
  record.segment = segment;
  record.T_world_cam = k.T_cam_world.inverse();
  record.is_doubtful = k.is_doubtful;
  record.points.reserve(k.points.size());
  std::optional<ImageView<uint8_t>> gray;
  if (k.pyramid) gray = k.pyramid->finest().gray.view();
  for (const MapPoint& p : k.points) {
    EdgePoint e;
    e.px = p.px.cast<float>();
    e.normal = p.normal.cast<float>();
    e.idepth = float(p.idepth);
    e.idepth_sigma = float(p.idepth_sigma);
    e.observations = int(p.observations.size());
    if (gray) e.gray = gray->at(int(std::lround(e.px.x())), int(std::lround(e.px.y())));
    record.points.push_back(e);
  }
  return record;
}

Map::Map(const Rectification& rectification, std::shared_ptr<MapLog> log)
    : rectification_(rectification), log_(std::move(log)) {}

void Map::add(Keyframe keyframe) {
  if (segment_ >= 0) log_->append(KeyframeAdded{keyframe.id, keyframe.frame_index, segment_});
  active_.push_back(std::move(keyframe));
}

void Map::discard() { active_.clear(); }

void Map::begin_segment(int segment) {
  segment_ = segment;
  for (const Keyframe& k : active_) log_->append(KeyframeAdded{k.id, k.frame_index, segment_});
  announce_window();
}

const Keyframe& Map::marginalise_oldest(std::vector<NeighbourPose> neighbours) {
  marginalised_.push_back(std::move(active_.front()));
  active_.pop_front();
  Keyframe& k = marginalised_.back();
  k.immature = {};
  k.corners = {};
  k.points = std::vector<MapPoint>(k.points);  // without spare capacity: it may stay for long
  auto record = std::make_shared<const KeyframeRecord>(make_record(k, segment_));
  stored_[k.id] = {segment_, record};
  log_->append(KeyframeMarginalised{k.id, std::move(record), std::move(neighbours), k.pyramid});
  return k;
}

void Map::announce_window() {
  auto keyframes = std::make_shared<std::vector<WindowAdjusted::Active>>();
  keyframes->reserve(active_.size());
  for (const Keyframe& k : active_) keyframes->push_back({k.id, make_record(k, segment_), k.pyramid});
  log_->append(WindowAdjusted{moves_, std::move(keyframes)});
}

void Map::end_segment() {
  announce_window();
  marginalised_.clear();
  segment_ = -1;
}

void Map::evict_images(size_t keep) {
  for (size_t i = 0; i + keep < marginalised_.size(); ++i) marginalised_[i].pyramid.reset();
}

void Map::evict_records() {
  const int first = !marginalised_.empty() ? marginalised_.front().id
                    : !active_.empty()     ? active_.front().id
                                           : std::numeric_limits<int>::max();
  stored_.erase(stored_.begin(), stored_.lower_bound(first));
}

void Map::evict_matches(size_t keep) {
  while (marginalised_.size() > keep) marginalised_.pop_front();
}

}  // namespace edgevo
