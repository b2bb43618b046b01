// SPDX-License-Identifier: BSD-3-Clause
#include "view_keyframes.h"

#include "edgevo/map/run_builder.h"

namespace edgevo {

void ViewKeyframes::apply(const Pinhole& pinhole, const MapEvent& event) {
  if (const auto* placed = std::get_if<SegmentPlaced>(&event)) {
    placed_.epochs.push_back({placed->segment, 0, -1, placed->T_world_map, placed->scale_sigma});
  } else if (const auto* epochs = std::get_if<EpochsPlaced>(&event)) {
    placed_.epochs = epochs->epochs;
    T_odom_world_ = epochs->T_world_odom.inverse();
    ++moves_;
  } else if (const auto* marginalised = std::get_if<KeyframeMarginalised>(&event)) {
    place_[marginalised->id] = keyframes_.size();
    keyframes_.push_back(marginalised->keyframe);
    ids_.push_back(marginalised->id);
  } else if (const auto* moved = std::get_if<MapMoved>(&event)) {
    move(pinhole, *moved);
  }
}

void ViewKeyframes::move(const Pinhole& pinhole, const MapMoved& moved) {
  for (const KeyframeMove& move : moved.keyframes) {
    const auto place = place_.find(move.id);
    if (place == place_.end()) continue;  // still in the window
    auto keyframe = std::make_shared<KeyframeRecord>(*keyframes_[place->second]);
    // The lens, which a pinhole lacks, moves lines only, and these records have none.
    apply_move(pinhole, moved, move, keyframe.get());
    keyframes_[place->second] = std::move(keyframe);
  }
  ++moves_;
}

KeyframeRecord ViewKeyframes::in_live_frame(size_t i) const {
  KeyframeRecord keyframe = *keyframes_[i];
  if (const EpochPlace* epoch = placed_.find(keyframe.segment, ids_[i]))
    move_to_world(Sim3{1, T_odom_world_} * epoch->T_world_map, &keyframe);
  return keyframe;
}

}  // namespace edgevo
