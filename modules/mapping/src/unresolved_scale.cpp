// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/unresolved_scale.h"

#include <algorithm>
#include <cmath>

#include "edgevo/mapping/doubt_evaluation.h"

namespace edgevo {

namespace {

// Whether a comparison that is certain has found what was known: the unit of a young map moves on after the
// first one.
bool is_resolved(const RelativeScale& unit) {
  return unit.sigma <= kUnitKnown && std::abs(std::log(unit.ratio)) <= kUnitKnown;
}

}  // namespace

bool UnresolvedScale::is_about(const std::vector<TrustedReference>& before) const {
  return is_open() && before_.front().reference == before.front().reference;
}

void UnresolvedScale::note(int frame_index, const std::vector<TrustedReference>& before,
                           const TrustedReference& view, const RelativeScale& unit) {
  // One map is compared until something links it: it is no young one.
  const bool is_one_map = before.front().segment == view.segment;
  if (unit.is_linked() && (is_one_map || is_resolved(unit))) {
    // Known in the unit of `before`, which may itself be unknown in that of views still further back.
    if (is_about(before)) *this = {};
    return;
  }
  if (!is_open()) before_ = before, since_ = frame_index;
  constexpr int kSoonest = 5;  // frames
  next_ = frame_index + std::max(kSoonest, (frame_index - since_) / 2);
  last_keyframe_ = view.reference->keyframe_id;
}

bool UnresolvedScale::is_due(int frame_index, const TrustedReference& view) const {
  return is_open() && frame_index >= next_ && view.reference->keyframe_id != last_keyframe_;
}

}  // namespace edgevo
