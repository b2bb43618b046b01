// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/relit_source.h"

namespace edgevo {

std::optional<int> RelitSource::size() const { return relight_.may_drop() ? std::nullopt : inner().size(); }

std::vector<Timestamp> RelitSource::times() const {
  return relight_.may_drop() ? std::vector<Timestamp>() : inner().times();
}

std::optional<Frame> RelitSource::next() {
  while (std::optional<Frame> frame = inner().next()) {
    if (!begin_) begin_ = frame->time;
    if (relight_.drops(frame->index)) continue;
    frame->image = relight_.apply(frame->image, frame->index, seconds_between(*begin_, frame->time));
    return frame;
  }
  return std::nullopt;
}

}  // namespace edgevo
