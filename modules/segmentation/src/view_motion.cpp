// SPDX-License-Identifier: BSD-3-Clause
#include "view_motion.h"

#include <utility>

namespace edgevo {
namespace {

constexpr int kMinInBlock = 4;  // edges that show whether a block moves
// Share that keeps its place: of a block's edges; of all blocks, before anything has crossed; and of those
// that stood, from image to image: what crosses covers them little by little, a camera that starts moves all
// at once.
constexpr double kMinStill = 0.7;
constexpr int kMinImages = 2;          // for one, every slow camera stands
constexpr double kMinStanding = 0.05;  // share of the blocks that are still before a camera that stands
constexpr int kMaxCrossing = 30;       // images in which most of the view moves that was not seen to stand

}  // namespace

// What crosses the view covers, little by little, what stood still all over it; else the rest is fixed to a
// camera that moves.
void ViewMotion::end_standstill_of_fixed_part(int still) {
  was_all_still_ = stands_ && (was_all_still_ || still >= kMinStill * voting_);
  const bool may_be_fixed = stands_ && !was_all_still_;
  crossed_images_ = may_be_fixed ? crossed_images_ + (2 * moving_ > voting_) : 0;
  if (crossed_images_ > kMaxCrossing) stands_ = false;
}

void ViewMotion::vote(const KeptEdges& edges, const std::vector<uint8_t>& votes) {
  constexpr size_t kBlocks = kColumns * kRows;
  std::vector<int> all(kBlocks), seen(kBlocks);
  for (const KeptEdge& e : edges.all()) {
    if (!votes[size_t(e.cell)]) continue;
    ++all[size_t(edges.block(e.cell))];
    seen[size_t(edges.block(e.cell))] += e.seen;
  }
  std::vector<uint8_t> stood = std::exchange(still_, std::vector<uint8_t>(kBlocks));
  stood.resize(kBlocks);
  moves_.assign(kBlocks, 0);
  voting_ = moving_ = 0;
  int still = 0, stood_blocks = 0, still_standing = 0;
  for (size_t i = 0; i < kBlocks; ++i) {
    if (all[i] < kMinInBlock) continue;
    ++voting_;
    moves_[i] = 2 * seen[i] < all[i];
    moving_ += moves_[i];
    still_[i] = seen[i] >= kMinStill * all[i];
    still += still_[i];
    stood_blocks += stood[i];
    still_standing += stood[i] && still_[i];
  }
  stands_ = stands_ ? still_standing >= kMinStill * stood_blocks && still >= kMinStanding * voting_
                    : voting_ > 0 && 2 * still >= voting_;
  end_standstill_of_fixed_part(still);
  standing_ = stands_ ? standing_ + 1 : 0;
  since_moving_ = stands_ || moving_ <= still ? since_moving_ + 1 : 0;
}

StillCells ViewMotion::still_cells() const {
  if (standing_ < kMinImages) return {0, 0, {}, since_moving_};
  return {kColumns, kRows, still_, since_moving_, was_all_still_};
}

}  // namespace edgevo
