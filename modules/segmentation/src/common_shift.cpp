// SPDX-License-Identifier: BSD-3-Clause
#include "common_shift.h"

#include <utility>

#include "view_motion.h"

namespace edgevo {
namespace {

constexpr int kReachPx = 8;         // of the level: searched around the last step, and kept between images
constexpr size_t kMostEdges = 120;  // for a search: two numbers
constexpr int kEnough = 2;          // images that are unlike

}  // namespace

Eigen::Vector2f CommonShift::best_shift(const std::vector<const KeptEdge*>& moved, const Gradient& gradient,
                                        const RowShifts& rows) const {
  const size_t number = std::min(moved.size(), kMostEdges);
  Eigen::Vector2f best = Eigen::Vector2f::Zero();
  int most = -1;
  const auto search = [&](const Eigen::Vector2f& centre, int reach, float step) {
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const Eigen::Vector2f shift = centre + step * Eigen::Vector2f(float(x), float(y));
        int shown = 0;
        for (size_t i = 0; i < number; ++i)
          shown += base_->shows(*moved[i * moved.size() / number], gradient, rows, shift);
        if (shown > most) most = shown, best = shift;
      }
  };
  search(shift_ + step_, kReachPx, 1);
  search(Eigen::Vector2f(best), 1, 0.5f);
  return best;
}

// Whether in most blocks most edges are where the shift puts them.
bool CommonShift::moves_alike(const std::vector<const KeptEdge*>& moved, const Gradient& gradient,
                              const RowShifts& rows) const {
  std::vector<int> all(ViewMotion::kColumns * ViewMotion::kRows), shown(all.size());
  for (const KeptEdge* e : moved) {
    if (!base_->contains(Eigen::Vector2f(e->x, e->y) + shift_)) continue;
    ++all[size_t(base_->block(e->cell))];
    shown[size_t(base_->block(e->cell))] += base_->shows(*e, gradient, rows, shift_);
  }
  int blocks = 0, alike = 0;
  for (size_t i = 0; i < all.size(); ++i) blocks += all[i] > 0, alike += 2 * shown[i] > all[i];
  return 2 * alike > blocks;
}

bool CommonShift::is_seen(const KeptEdges& before, const Gradient& gradient, const RowShifts& rows,
                          const std::vector<uint8_t>& votes, const std::vector<uint8_t>& stays, bool stands) {
  if (unlike_ >= kEnough) return false;
  if (!base_) {
    base_ = before;
    shift_ = step_ = Eigen::Vector2f::Zero();
  }
  std::vector<const KeptEdge*> moved;
  for (const KeptEdge& e : base_->all())
    if (votes[size_t(e.cell)] && !stays[size_t(base_->block(e.cell))]) moved.push_back(&e);
  const Eigen::Vector2f last = std::exchange(shift_, best_shift(moved, gradient, rows));
  const bool is_alike = moves_alike(moved, gradient, rows);
  unlike_ = is_alike ? 0 : unlike_ + 1;
  step_ = is_alike ? Eigen::Vector2f(shift_ - last) : Eigen::Vector2f::Zero();
  is_far_ = !is_alike || shift_.norm() > kReachPx;
  return is_alike || (stands && unlike_ < kEnough);
}

}  // namespace edgevo
