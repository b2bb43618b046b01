// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Whether all that moves in a view may be one body that slides by: a train next to a camera that stands.
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "kept_edges.h"

namespace edgevo {

/// Part of a view stays and the rest does not: a camera with a part that is fixed to it drives, or one that
/// stands looks past a body. A scene has depth, it moves differently here and there; a body that slides by
/// moves all alike. A camera that only pans looks the same: nothing is known until it does something else.
class CommonShift {
 public:
  /// Compares the next image with an earlier one, at first `before`, in the blocks of the view that do not
  /// stay; `votes`, by cell: 0 where edges are no evidence. Returns whether most of what moves has moved
  /// alike. If the camera `stands` as far as is known, one image that is unlike proves nothing. After two
  /// the answer stays. Cost: 0.4 ms.
  bool is_seen(const KeptEdges& before, const Gradient& gradient, const RowShifts& rows,
               const std::vector<uint8_t>& votes, const std::vector<uint8_t>& stays, bool stands);
  /// Compares the next images with this one, if it is time for that.
  template <class Renew>
  void renew(const Renew& renew) {
    if (base_ && is_far_) renew(&*base_), is_far_ = false, shift_.setZero();
  }
  /// Forgets what was seen: all stays again.
  void clear() { base_.reset(), unlike_ = 0; }

 private:
  Eigen::Vector2f best_shift(const std::vector<const KeptEdge*>& moved, const Gradient& gradient,
                             const RowShifts& rows) const;
  bool moves_alike(const std::vector<const KeptEdge*>& moved, const Gradient& gradient,
                   const RowShifts& rows) const;

  std::optional<KeptEdges> base_;
  // Since that image, and from the last one to the newest.
  Eigen::Vector2f shift_ = Eigen::Vector2f::Zero(), step_ = Eigen::Vector2f::Zero();
  bool is_far_ = false;  // that image is too different
  int unlike_ = 0;       // images in a row
};

}  // namespace edgevo
