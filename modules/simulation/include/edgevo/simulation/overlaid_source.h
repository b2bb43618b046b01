// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Another source with bodies pasted over it, in which the camera may stand for a while.
#include <memory>

#include "edgevo/core/wrapped_source.h"
#include "edgevo/simulation/overlay.h"

namespace edgevo {

/// A source with foreign bodies. Where the camera stands, frames are numbered anew, have no files of their
/// own, and those after the stop are later by its duration.
class OverlaidSource : public WrappedSource {
 public:
  /// `source` is not null. Throws InputError as Overlay does.
  OverlaidSource(std::unique_ptr<ImageSource> source, const OverlayOptions& options);

  /// Number of frames with those of the stop.
  std::optional<int> size() const override;
  std::string kind() const override { return inner().kind() + ", with foreign bodies"; }
  /// Times of the source; empty if the camera stands.
  std::vector<Timestamp> times() const override;
  std::optional<Frame> next() override;
  bool skip() override { return next().has_value(); }

  /// Mask of the bodies that move by themselves in the frame that next() returned last: 255 where the scene
  /// is seen, 0 where one hides it.
  GrayImage moving_mask() const;
  /// Mask of the own part; empty if there is none.
  GrayImage own_part_mask() const;
  /// Ground truth of the new sequence, from that of the source; valid after the last frame.
  std::string ground_truth(const std::string& tum) const;

 private:
  std::optional<Frame> next_real();
  Frame finish(Frame frame, std::optional<int> standing);

  Overlay overlay_;
  std::optional<Timestamp> begin_;
  std::optional<Frame> stopped_;  // the frame that is repeated
  int read_ = 0, written_ = 0, stood_ = 0;
  double step_s_;
  std::vector<uint8_t> moving_;
};

}  // namespace edgevo
