// SPDX-License-Identifier: BSD-3-Clause
#include "first_keyframes.h"

#include <algorithm>
#include <limits>

#include "edgevo/mapping/idepth_prior.h"

namespace edgevo {

IdepthRange range_near(const std::vector<BootstrapCorner>& corners, bool in_last, const Eigen::Vector2d& px) {
  double best = std::numeric_limits<double>::infinity(), idepth = 1;
  for (const BootstrapCorner& c : corners) {
    const double d = ((in_last ? c.px_last : c.px_first) - px).squaredNorm();
    if (d < best) best = d, idepth = in_last ? c.idepth_last : c.idepth_first;
  }
  return range_around(idepth, idepth);
}

// Two views alone are not enough: an edge match is one equation, and with one match per point the point's own
// depth absorbs it, so that the pose between the two views would be free.
std::vector<const BootstrapView*> choose_keyframe_views(const std::vector<BootstrapView>& views) {
  constexpr size_t kMaxBetween = 3;  // with five keyframes in all a point has up to four matches
  std::vector<const BootstrapView*> between;
  for (size_t i = 1; i + 1 < views.size(); ++i)
    if (views[i].placed && views[i].pyramid) between.push_back(&views[i]);
  std::vector<const BootstrapView*> chosen{&views.front()};
  const size_t n = std::min(kMaxBetween, between.size());
  for (size_t k = 0; k < n; ++k) chosen.push_back(between[(2 * k + 1) * between.size() / (2 * n)]);
  chosen.push_back(&views.back());
  return chosen;
}

}  // namespace edgevo
