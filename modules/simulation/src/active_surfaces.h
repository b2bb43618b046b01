// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The surfaces that may be visible in a row of the image, row by row.
#include <vector>

#include "view.h"

namespace edgevo {

/// Calls `draw(surface, its number)` for the surfaces that may touch row v; rows must be requested in order.
/// Cut-outs come last, from near to far, so that their masks are evaluated only where they are not hidden.
class ActiveSurfaces {
 public:
  explicit ActiveSurfaces(const std::vector<ViewSurface>& views);
  template <class Draw>
  void for_row(int v, Draw draw) {
    for (; next_ < by_row_.size() && views_[size_t(by_row_[next_])].row_begin <= v; ++next_)
      enter(by_row_[next_]);
    for (std::vector<int>* active : {&opaque_, &cut_out_}) {
      active->erase(std::remove_if(active->begin(), active->end(),
                                   [&](int i) { return views_[size_t(i)].row_end <= v; }),
                    active->end());
      for (int i : *active) draw(views_[size_t(i)], i);
    }
  }

 private:
  void enter(int i);
  const std::vector<ViewSurface>& views_;
  std::vector<int> by_row_, opaque_, cut_out_;
  size_t next_ = 0;
};

}  // namespace edgevo
