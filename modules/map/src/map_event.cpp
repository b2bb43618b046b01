// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/map/map_event.h"

#include <algorithm>

namespace edgevo {

const KeyframeMove* MapMoved::find(int keyframe_id) const {
  const auto move = std::lower_bound(keyframes.begin(), keyframes.end(), keyframe_id,
                                     [](const KeyframeMove& m, int id) { return m.id < id; });
  return move != keyframes.end() && move->id == keyframe_id ? &*move : nullptr;
}

}  // namespace edgevo
