// SPDX-License-Identifier: BSD-3-Clause
#include "live_metres.h"

#include "edgevo/map/run_builder.h"

namespace edgevo {

LiveMetres::LiveMetres(const ScaleSource& source, const VehicleTrack& track, const Pinhole& pinhole,
                       const std::optional<SE3>& T_vehicle_cam, const ScaleParams& params)
    : source_(source), live_(pinhole, source, track, T_vehicle_cam, params) {
  if (source_.kind == ScaleSource::Kind::kFactor) newest_ = {source_.value, 0, 0};
}

void LiveMetres::apply(const MapEvent& event) {
  if (!source_.is_estimated()) return;
  if (const auto* placed = std::get_if<SegmentPlaced>(&event)) {
    T_odom_map_[placed->segment] = placed->T_world_map;
    waiting_.clear();
  } else if (const auto* epochs = std::get_if<EpochsPlaced>(&event)) {
    add_waiting();
    follow(*epochs);
  } else if (const auto* frame = std::get_if<FrameAnchored>(&event)) {
    add_waiting();
    live_.add_frame(frame->frame);
  } else if (const auto* marginalised = std::get_if<KeyframeMarginalised>(&event)) {
    waiting_.push_back(*marginalised);
  } else if (const auto* moved = std::get_if<MapMoved>(&event)) {
    add_waiting();
    live_.apply(*moved);
  }
  if (live_.newest()) newest_ = live_.newest();
}

// The live path goes on in the unit of the newest epoch.
void LiveMetres::follow(const EpochsPlaced& epochs) {
  const auto T_odom_map = T_odom_map_.find(epochs.segment);
  if (T_odom_map == T_odom_map_.end() || epochs.epochs.empty()) return;
  int first_keyframe = epochs.epochs.front().first_keyframe;
  for (const EpochPlace& e : epochs.epochs)
    if (e.segment == epochs.segment) first_keyframe = e.first_keyframe;
  live_.rescale(epochs.segment, first_keyframe, epochs.T_odom_map.scale / T_odom_map->second.scale);
  T_odom_map->second = epochs.T_odom_map;
}

void LiveMetres::add_waiting() {
  for (const KeyframeMarginalised& marginalised : waiting_) {
    KeyframeRecord keyframe = *marginalised.keyframe;
    const auto T_odom_map = T_odom_map_.find(keyframe.segment);
    if (T_odom_map == T_odom_map_.end()) continue;
    move_to_world(T_odom_map->second, &keyframe);
    live_.add_keyframe(marginalised.id, keyframe);
  }
  waiting_.clear();
}

}  // namespace edgevo
