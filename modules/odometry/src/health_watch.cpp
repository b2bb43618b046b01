// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/odometry/health_watch.h"

#include <utility>

namespace edgevo {

// Whether the view is that by which a new map was joined to the one before.
bool HealthWatch::repeats_join(const SureView& view) {
  if (std::exchange(begins_map_, false)) joined_by_ = view.reference->keyframe_id;
  return joined_by_ == view.reference->keyframe_id;
}

HealthWatch::Health HealthWatch::add(int frame_index, const SureView& view, bool is_doubtful) {
  const bool is_join = repeats_join(view);
  const bool follows_loss = std::exchange(was_lost_, false), is_sure = !is_doubtful && !follows_loss;
  sure_ = is_sure ? sure_ + 1 : 0;
  if (!is_sure) {
    if (state_ == Health::kSure && !follows_loss) go_back_before(frame_index - kDoubtReach);
    return state_ = Health::kInDoubt;
  }
  if (state_ == Health::kInDoubt && (sure_ < kDoubtReach || is_join)) return state_;
  joined_by_.reset();
  const bool has_returned = state_ == Health::kInDoubt;
  if (has_returned) recent_.clear();
  if (recent_.empty() || recent_.back().reference != view.reference) recent_.push_back(view);
  while (recent_.size() > 1 && recent_[1].frame_index <= frame_index - kDoubtReach) recent_.pop_front();
  state_ = Health::kSure;
  // While the return is evaluated, before() is still the view before the doubt.
  if (has_returned) return Health::kReturned;
  before_ = recent_.back();
  return Health::kSure;
}

void HealthWatch::begin_map() {
  state_ = before_ ? Health::kInDoubt : Health::kSure;
  was_lost_ = false;
  begins_map_ = state_ == Health::kInDoubt;
  joined_by_.reset();
  sure_ = 0;
  recent_.clear();
}

// Up to a loss the frames were sure, so that before() is the newest reference.
void HealthWatch::add_lost() {
  was_lost_ = true;
  sure_ = 0;
}

void HealthWatch::go_back_before(int frame_index) {
  if (recent_.empty()) return;
  before_ = recent_.front();
  for (const SureView& view : recent_)
    if (view.frame_index <= frame_index) before_ = view;
}

}  // namespace edgevo
