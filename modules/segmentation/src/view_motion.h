// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How much of the view moves, from edges and the steepest pixels between them, by its extent: each block has
// one vote, however many edges it shows. What is known to be fixed to the camera has none.
#include <vector>

#include "edgevo/segmentation/still_cells.h"
#include "kept_edges.h"

namespace edgevo {

/// The votes of the blocks from image to image.
class ViewMotion {
 public:
  /// Blocks of the view.
  static constexpr int kColumns = 16, kRows = 8;

  /// Takes a vote: edges of an image, as the present one shows them. `votes`, by cell: 0 where they are no
  /// evidence.
  void vote(const KeptEdges& edges, const std::vector<uint8_t>& votes);
  /// Whether most of the view moves, so that what does not is evidence.
  bool is_moving() const { return !stands_ && voting_ > 0 && 2 * moving_ >= voting_; }
  /// By block: 1 where most edges leave their place.
  const std::vector<uint8_t>& moves() const { return moves_; }
  /// The blocks that stand still before a camera that stands; else empty. It stands if half of the view
  /// stands still. Once it stands, what crosses the view may cover more, little by little; a camera that
  /// begins to move moves everything at once. Where most of the view moves for long and was never seen to
  /// stand, the rest is fixed to a camera that moves.
  StillCells still_cells() const;

 private:
  void end_standstill_of_fixed_part(int still);

  int voting_ = 0, moving_ = 0;
  int standing_ = 0, since_moving_ = 0;  // images
  bool stands_ = false;
  std::vector<uint8_t> moves_, still_;
  // Of a camera that stands: whether nearly all was seen to stand still; if not, images in which most moved.
  bool was_all_still_ = false;
  int crossed_images_ = 0;
};

}  // namespace edgevo
