// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Frames that have arrived, and were answered without a pose, before the map was there that gives them one.
#include <deque>
#include <memory>
#include <utility>

#include "edgevo/tracking/front_end.h"

namespace edgevo {

/// A frame without its image.
struct BufferedFrame {
  /// Of a frame that has arrived.
  explicit BufferedFrame(const ArrivedFrame& arrived)
      : pyramid(arrived.pyramid), rows(arrived.rows), still(arrived.still) {
    frame.index = arrived.frame.index;
    frame.time = arrived.frame.time;
  }

  /// Index and time.
  Frame frame;
  /// Its edge pyramid.
  std::shared_ptr<const FramePyramid> pyramid;
  /// How the rows of its image were rectified.
  RowRectification rows;
  /// What stands still in its view.
  StillCells still;
};

/// A queue of such frames, bounded like what a camera may have waiting.
class FrameBuffer {
 public:
  /// Whether no frame waits.
  bool empty() const { return frames_.empty(); }
  /// Drops all frames.
  void clear() { frames_.clear(); }
  /// Beyond the bound the oldest is lost.
  void add(const ArrivedFrame& arrived) {
    constexpr size_t kMax = 24;
    if (frames_.size() >= kMax) frames_.pop_front();
    frames_.emplace_back(arrived);
  }
  /// Drops the frames up to this index.
  void drop_until(int index) {
    while (!frames_.empty() && frames_.front().frame.index <= index) frames_.pop_front();
  }
  /// Removes the oldest and returns it; there must be one.
  BufferedFrame take() {
    BufferedFrame oldest = std::move(frames_.front());
    frames_.pop_front();
    return oldest;
  }

 private:
  std::deque<BufferedFrame> frames_;
};

}  // namespace edgevo
