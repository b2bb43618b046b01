// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/map_coverage.h"

#include <algorithm>

#include "edgevo/confidence/frame_status.h"

namespace edgevo {

MapInView MapCoverage::look(const FrameEvidence& evidence) {
  constexpr int kMany = 12;  // a keyframe may end a shorter interval
  if (!is_out_of_view(evidence, params_)) {
    unexplained_frames_ = 0;  // fast motion also blurs images of a map that is in view
    return MapInView::kYes;
  }
  unexplained_frames_ = std::clamp(unexplained_frames_ + (is_explained(evidence) ? -1 : 1), 0, 2 * kMany);
  const bool is_out = unexplained_frames_ >= kMany && may_be_out_of_view_;
  return is_out ? MapInView::kNo : MapInView::kUncertain;
}

}  // namespace edgevo
