// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/point_filter.h"

namespace edgevo {

PointCounts count_points(const Run& run, const PointFilter& filter) {
  PointCounts n;
  for (const KeyframeRecord& keyframe : run.keyframes) {
    for (const EdgePoint& p : keyframe.points) {
      ++n.total;
      if (!PointFilter::is_valid(p))
        ++n.invalid;
      else if (!filter.is_certain(p))
        ++n.uncertain;
      else if (!filter.is_confirmed(p))
        ++n.unconfirmed;
      else
        ++n.kept;
    }
  }
  return n;
}

}  // namespace edgevo
