// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How much of the view moves, from edges and the steepest pixels between them, by its extent: each block has
// one vote, however many edges it shows. What is known to be fixed to the camera has none.
#include <vector>

#include "edgevo/segmentation/still_cells.h"
#include "kept_edges.h"

namespace edgevo {

/// The votes of the blocks from image to image.
///
/// A camera stands if half of the view stands still. What crosses the view then covers more, block by block:
/// edges vanish there. A camera that begins to move moves everything at once, or slides it little by little.
/// So a camera that was seen to stand is taken to stand while its view is covered, all of it even. Where most
/// of the view moves for long and was never seen to stand, the rest is fixed to a camera that moves.
class ViewMotion {
 public:
  /// Blocks of the view.
  static constexpr int kColumns = 16, kRows = 8;

  /// Takes a vote: edges of an image, as the present one shows them. `votes`, by cell: 0 where they are no
  /// evidence.
  void vote(const KeptEdges& edges, const std::vector<uint8_t>& votes);
  /// Whether most of the view moves, so that what does not is evidence.
  bool is_moving() const { return !stands_ && voting_ > 0 && 2 * moving_ >= voting_; }
  /// Whether the camera seems to stand.
  bool stands() const { return stands_; }
  /// By block: 1 where most edges leave their place.
  const std::vector<uint8_t>& moves() const { return moves_; }
  /// The blocks that stand still before a camera that stands; else empty.
  StillCells still_cells() const;

 private:
  enum class Block : uint8_t { kMoves, kStill, kSlid, kHidden };
  void decide(int still, int stood, int still_standing);

  int voting_ = 0, moving_ = 0;
  int standing_ = 0, since_moving_ = 0;  // images
  bool stands_ = false;
  std::vector<uint8_t> moves_;
  std::vector<Block> blocks_;  // how each left its place, since the camera stands
  // Of a camera that stands: whether nearly all was seen to stand still; images in a row in which most moved,
  // each by the blocks that still stand.
  bool was_all_still_ = false;
  double crossed_images_ = 0;
};

}  // namespace edgevo
