// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Images of the window for a correction of the camera that is about to be applied, rebuilt next to mapping:
// some 8 ms each, and the map could not grow meanwhile.
#include <chrono>
#include <deque>
#include <future>
#include <map>
#include <memory>
#include <utility>

#include "edgevo/core/thread_priority.h"
#include "edgevo/core/trace.h"
#include "edgevo/map/keyframe.h"
#include "edgevo/mapping/mapper.h"

namespace edgevo {

/// Rebuilds images in a thread of its own; for one thread.
class RebuiltImages {
 public:
  explicit RebuiltImages(RebuildPyramid rebuild) : rebuild_(std::move(rebuild)) {}

  /// Rebuilds the images of the keyframes, one after another, and then those of keyframes that came
  /// meanwhile; call it again until it returns true. Some may still be missing then.
  bool prepare(const std::deque<Keyframe>& keyframes, const ImageCorrection& correction) {
    constexpr int kRounds = 3;
    if (rebuilding_.valid() && rebuilding_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
      return false;
    finish();
    Images missing = unknown(keyframes, correction);
    if (missing.empty() || rounds_ == kRounds) return true;
    begin(std::move(missing), correction);
    return false;
  }
  /// Waits for what is under way; rethrows what it threw. get() knows the images until clear().
  void finish() {
    if (rebuilding_.valid()) images_.merge(rebuilding_.get());
  }
  void clear() {
    images_.clear();
    rounds_ = 0;
  }

  /// The image of a keyframe with that correction, rebuilt now if it was not yet.
  std::shared_ptr<const FramePyramid> get(const Keyframe& k, const ImageCorrection& correction) const {
    return knows(k, correction) ? images_.at(k.pyramid).second : rebuild_(*k.pyramid, k.motion, correction);
  }

 private:
  /// By the image before: its motion, and the new image.
  using Images = std::map<std::shared_ptr<const FramePyramid>,
                          std::pair<ImageMotion, std::shared_ptr<const FramePyramid>>>;
  Images unknown(const std::deque<Keyframe>& keyframes, const ImageCorrection& correction) const {
    Images images;
    for (const Keyframe& k : keyframes)
      if (k.pyramid && !knows(k, correction)) images[k.pyramid] = {k.motion, nullptr};
    return images;
  }
  void begin(Images missing, const ImageCorrection& correction) {
    ++rounds_;
    rebuilding_ = std::async(std::launch::async, [this, correction, images = std::move(missing)]() mutable {
      name_traced_thread("corrected images");
      lower_thread_priority();
      for (auto& [pyramid, rebuilt] : images) rebuilt.second = rebuild_(*pyramid, rebuilt.first, correction);
      return std::move(images);
    });
  }
  bool knows(const Keyframe& k, const ImageCorrection& correction) const {
    const auto known = images_.find(k.pyramid);
    return known != images_.end() && known->second.second->correction == correction;
  }

  RebuildPyramid rebuild_;
  Images images_;
  int rounds_ = 0;
  std::future<Images> rebuilding_;  // last member: it waits for its thread
};

}  // namespace edgevo
