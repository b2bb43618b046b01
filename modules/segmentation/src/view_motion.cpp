// SPDX-License-Identifier: BSD-3-Clause
#include "view_motion.h"

#include <algorithm>

namespace edgevo {
namespace {

constexpr int kMinInBlock = 4;  // edges that show whether a block moves
constexpr int kMinImages = 2;   // for one, every slow camera stands
// Images in which most of the view moves and nothing supports that the camera stands: a bus of 2 to 6 s.
constexpr double kMaxCrossing = 60;

}  // namespace

void ViewMotion::decide(int still, int stood, int still_standing) {
  const auto number = [&](Block how) { return int(std::count(blocks_.begin(), blocks_.end(), how)); };
  const int hidden = number(Block::kHidden), left = stood - still_standing;
  const bool at_once = still_standing < kFoundAgain * stood && 2 * left >= hidden;
  const bool slides_off = number(Block::kSlid) > hidden + still;
  stands_ = stands_ ? !at_once && !slides_off : voting_ > 0 && 2 * still >= voting_;
  was_all_still_ = stands_ && (was_all_still_ || still >= kFoundAgain * voting_);
  // What still stands after a camera has driven off behind a bus would stand by chance, block by block.
  const double unsupported = 1.0 / (was_all_still_ ? 1 + still_standing : 1);
  crossed_images_ = stands_ && 2 * moving_ > voting_ ? crossed_images_ + unsupported : 0;
  if (crossed_images_ > kMaxCrossing) stands_ = false;
}

void ViewMotion::vote(const KeptEdges& edges, const std::vector<uint8_t>& votes) {
  constexpr size_t kBlocks = kColumns * kRows;
  std::vector<int> all(kBlocks), seen(kBlocks), slid(kBlocks);
  for (const KeptEdge& e : edges.all()) {
    if (!votes[size_t(e.cell)]) continue;
    const size_t block = size_t(edges.block(e.cell));
    ++all[block], seen[block] += e.seen, slid[block] += e.seen || e.slid;
  }
  if (!stands_) blocks_.assign(kBlocks, Block::kMoves);
  moves_.assign(kBlocks, 0);
  voting_ = moving_ = 0;
  int still = 0, stood = 0, still_standing = 0;
  for (size_t i = 0; i < kBlocks; ++i) {
    const bool was_still = blocks_[i] == Block::kStill;
    if (all[i] < kMinInBlock) continue;
    ++voting_;
    moves_[i] = 2 * seen[i] < all[i];
    moving_ += moves_[i];
    const bool is_still = seen[i] >= kFoundAgain * all[i];
    still += is_still, stood += was_still, still_standing += was_still && is_still;
    if (is_still)
      blocks_[i] = Block::kStill;
    else if (was_still)
      blocks_[i] = slid[i] >= kFoundAgain * all[i] ? Block::kSlid : Block::kHidden;
  }
  decide(still, stood, still_standing);
  standing_ = stands_ ? standing_ + 1 : 0;
  since_moving_ = stands_ || moving_ <= still ? since_moving_ + 1 : 0;
}

StillCells ViewMotion::still_cells() const {
  if (standing_ < kMinImages) return {0, 0, {}, since_moving_};
  std::vector<uint8_t> still(blocks_.size());
  for (size_t i = 0; i < still.size(); ++i) still[i] = blocks_[i] == Block::kStill;
  return {kColumns, kRows, std::move(still), since_moving_, was_all_still_};
}

}  // namespace edgevo
