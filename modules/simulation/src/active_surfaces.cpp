// SPDX-License-Identifier: BSD-3-Clause
#include "active_surfaces.h"

#include <algorithm>

namespace edgevo {

ActiveSurfaces::ActiveSurfaces(const std::vector<ViewSurface>& views) : views_(views) {
  for (int i = 0; i < int(views.size()); ++i) by_row_.push_back(i);
  std::stable_sort(by_row_.begin(), by_row_.end(),
                   [&](int a, int b) { return views[size_t(a)].row_begin < views[size_t(b)].row_begin; });
}

void ActiveSurfaces::enter(int i) {
  if (!views_[size_t(i)].texture->is_cut_out()) return opaque_.push_back(i);
  const auto nearer = [&](int a, int b) { return views_[size_t(a)].distance < views_[size_t(b)].distance; };
  cut_out_.insert(std::upper_bound(cut_out_.begin(), cut_out_.end(), i, nearer), i);
}

}  // namespace edgevo
