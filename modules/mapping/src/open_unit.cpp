// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/open_unit.h"

#include <algorithm>
#include <cmath>

#include "edgevo/mapping/doubt_evaluation.h"

namespace edgevo {

namespace {

// Whether a comparison that is certain has found nothing to set back: the unit of a young map moves on after
// the first one.
bool is_settled(const UnitComparison& unit) {
  return unit.sigma <= kUnitKnown && std::abs(std::log(unit.ratio)) <= kUnitKnown;
}

}  // namespace

bool OpenUnit::is_about(const std::vector<SureView>& before) const {
  return is_open() && before_.front().reference == before.front().reference;
}

void OpenUnit::note(int frame_index, const std::vector<SureView>& before, const SureView& view,
                    const UnitComparison& unit) {
  // One map is compared until something links it: it has kept its unit, and is no young one.
  const bool is_one_map = before.front().segment == view.segment;
  if (unit.is_linked() && (is_one_map || is_settled(unit))) {
    // Known in the unit of `before`, which may itself be unknown in that of views still further back.
    if (is_about(before)) *this = {};
    return;
  }
  if (!is_open()) before_ = before, since_ = frame_index;
  sigma_ = sigma(view.segment);
  segment_ = view.segment;
  if (unit.is_linked() && is_about(before)) sigma_ = std::min(sigma_, unit.sigma);
  constexpr int kSoonest = 5;  // frames
  next_ = frame_index + std::max(kSoonest, (frame_index - since_) / 2);
  last_keyframe_ = view.reference->keyframe_id;
}

bool OpenUnit::is_due(int frame_index, const SureView& view) const {
  return is_open() && frame_index >= next_ && view.reference->keyframe_id != last_keyframe_;
}

}  // namespace edgevo
