// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/found_segments.h"

#include <algorithm>
#include <variant>

namespace edgevo {

void FoundSegments::apply(const MapEvent& event) {
  if (const auto* added = std::get_if<KeyframeAdded>(&event)) segment_of_[added->id] = added->segment;
  if (const auto* stated = std::get_if<ConstraintAdded>(&event)) {
    const Constraint& c = stated->constraint;
    const bool is_in_kept_map = c.kind == ConstraintKind::kPlace && c.from == NodeId::world() &&
                                c.to.kind() == NodeId::Kind::kKeyframe;
    const auto segment = is_in_kept_map ? segment_of_.find(c.to.number()) : segment_of_.end();
    if (segment != segment_of_.end()) found_[stated->id] = segment->second;
  }
  if (const auto* withdrawn = std::get_if<ConstraintWithdrawn>(&event)) found_.erase(withdrawn->id);
  if (const auto* placed = std::get_if<EpochsPlaced>(&event)) newest_placed_ = placed->newest_constraint;
}

bool FoundSegments::contains(int segment) const {
  return std::any_of(found_.begin(), found_.end(),
                     [&](const auto& by) { return by.second == segment && by.first <= newest_placed_; });
}

}  // namespace edgevo
