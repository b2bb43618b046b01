// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <deque>
#include <map>
#include <mutex>
#include <string>

#include "edgevo/core/bad_frame.h"
#include "edgevo/core/image_source.h"

namespace edgevo {

/// Wraps a source and returns its bad frames (core/bad_frame.h) without image instead of throwing. A bad
/// image before any good frame is still thrown, as is the eleventh bad time: the source is then at fault, not
/// the frame.
class LenientSource : public ImageSource {
 public:
  explicit LenientSource(ImageSource& inner) : inner_(inner) {}

  const Camera& camera() const override { return inner_.camera(); }
  std::optional<int> size() const override { return inner_.size(); }
  std::string kind() const override { return inner_.kind(); }
  bool is_live() const override { return inner_.is_live(); }
  std::optional<Frame> next() override;

  /// Reason why a frame came without image; the second call for a frame returns nothing. Thread-safe.
  std::string take_reason(int frame_index);

 private:
  std::optional<Frame> next_in_order();

  ImageSource& inner_;
  bool good_came_ = false;
  std::deque<Frame> waiting_;  // frames without a time before the first good one, and that one
  std::mutex mutex_;           // guards reasons_
  std::map<int, std::string> reasons_;
};

}  // namespace edgevo
