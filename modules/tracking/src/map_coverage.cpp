// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/map_coverage.h"

#include <algorithm>

#include "edgevo/confidence/frame_status.h"

namespace edgevo {
namespace {

constexpr int kManyUnexplained = 12;  // frames; a keyframe may end a shorter interval

}  // namespace

MapInView MapCoverage::look(const FrameEvidence& evidence) {
  if (!is_out_of_view(evidence)) {
    unexplained_frames_ = 0;  // fast motion also blurs images of a map that is in view
    return MapInView::kYes;
  }
  unexplained_frames_ =
      std::clamp(unexplained_frames_ + (is_explained(evidence) ? -1 : 1), 0, 2 * kManyUnexplained);
  const bool is_out = unexplained_frames_ >= kManyUnexplained && may_be_out_of_view_;
  return is_out ? MapInView::kNo : MapInView::kUncertain;
}

}  // namespace edgevo
