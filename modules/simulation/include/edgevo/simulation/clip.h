// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A source held in memory for repeated playback: rendering a frame costs more than tracking it.
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "edgevo/core/gyro_sample.h"
#include "edgevo/core/image_source.h"

namespace edgevo {

/// The frames of a source in memory.
struct Clip {
  /// Camera of the source.
  Camera camera;
  /// Kind of the source.
  std::string kind;
  /// Frames in time order.
  std::vector<Frame> frames;
  /// What a gyro next to the camera measured, in time order; empty: there is none.
  std::vector<GyroSample> gyro = {};
};

/// Reads a source to its end, calling `on_frame` with the number of frames so far; if it returns false, the
/// clip ends there. Memory: the images.
std::shared_ptr<const Clip> read_clip(ImageSource& source, const std::function<bool(int)>& on_frame);

/// The same frames in reverse order; index and time are mirrored (first + last - own), so that both still
/// increase, and the rates of the gyro are reversed.
std::shared_ptr<const Clip> played_backward(const Clip& clip);

/// The clip as recorded by an overloaded recorder: nearly a third of the frames is missing, drawn by `seed`,
/// and from the 50th on four in a row every 60. The others keep index and time.
std::shared_ptr<const Clip> with_gaps(const Clip& clip, uint64_t seed);

/// Plays a clip.
class ClipSource : public ImageSource {
 public:
  /// `clip` is shared and not null.
  explicit ClipSource(std::shared_ptr<const Clip> clip) : clip_(std::move(clip)) {}

  const Camera& camera() const override { return clip_->camera; }
  std::optional<int> size() const override { return int(clip_->frames.size()); }
  std::string kind() const override { return clip_->kind; }
  GyroReadings gyro_readings() const override;
  std::vector<Timestamp> times() const override;
  std::optional<Frame> next() override;
  bool skip() override;

 private:
  std::shared_ptr<const Clip> clip_;
  size_t next_ = 0;
};

}  // namespace edgevo
