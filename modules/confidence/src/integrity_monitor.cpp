// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/confidence/integrity_monitor.h"

#include <algorithm>
#include <utility>

namespace edgevo {

// Whether the view is that by which a new map was joined to the one before.
bool IntegrityMonitor::repeats_join(const TrustedReference& view) {
  if (std::exchange(begins_map_, false)) joined_by_ = view.reference->keyframe_id;
  return joined_by_ == view.reference->keyframe_id;
}

IntegrityMonitor::Integrity IntegrityMonitor::add(int frame_index, const TrustedReference& view,
                                                  bool is_doubtful) {
  if (returned_) before_ = {*returned_};
  returned_.reset();
  const bool is_join = repeats_join(view);
  const bool follows_loss = std::exchange(was_lost_, false), is_sure = !is_doubtful && !follows_loss;
  sure_ = is_sure ? sure_ + 1 : 0;
  if (!is_sure) {
    if (state_ == Integrity::kNominal && !follows_loss) go_back_before(frame_index - kDoubtReach);
    return state_ = Integrity::kInDoubt;
  }
  if (state_ == Integrity::kInDoubt && (sure_ < kDoubtReach || is_join)) return state_;
  joined_by_.reset();
  // While the return is evaluated, before() are still the views before the doubt.
  if (std::exchange(state_, Integrity::kNominal) == Integrity::kInDoubt) {
    returned_ = view;
    return Integrity::kRecovered;
  }
  remember(view);
  return Integrity::kNominal;
}

void IntegrityMonitor::begin_map() {
  state_ = before_.empty() ? Integrity::kNominal : Integrity::kInDoubt;
  was_lost_ = false;
  begins_map_ = state_ == Integrity::kInDoubt;
  joined_by_.reset();
  sure_ = 0;
}

// Up to a loss the frames were sure, so that before() begins with the newest reference.
void IntegrityMonitor::add_lost() {
  was_lost_ = true;
  sure_ = 0;
}

void IntegrityMonitor::remember(const TrustedReference& view) {
  constexpr size_t kMax = 8;
  if (!before_.empty() && before_.front().reference == view.reference) return;
  before_.erase(std::remove_if(before_.begin(), before_.end(),
                               [&](const TrustedReference& v) {
                                 return v.segment == view.segment &&
                                        v.reference->keyframe_id == view.reference->keyframe_id;
                               }),
                before_.end());
  before_.insert(before_.begin(), view);
  if (before_.size() > kMax) before_.pop_back();
}

void IntegrityMonitor::go_back_before(int frame_index) {
  while (before_.size() > 1 && before_.front().frame_index > frame_index) before_.erase(before_.begin());
}

}  // namespace edgevo
