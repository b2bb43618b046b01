// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/clip.h"

#include <algorithm>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

std::vector<GyroSample> samples_of(const ImageSource& source) {
  std::vector<GyroSample> samples;
  const GyroReadings readings = source.gyro_readings();
  while (const std::optional<GyroSample> sample = readings ? readings() : std::nullopt)
    samples.push_back(*sample);
  return samples;
}

}  // namespace

std::shared_ptr<const Clip> read_clip(ImageSource& source, const std::function<bool(int)>& on_frame) {
  auto clip = std::make_shared<Clip>(Clip{source.camera(), source.kind(), {}, samples_of(source)});
  while (std::optional<Frame> frame = source.next()) {
    clip->frames.push_back(std::move(*frame));
    if (!on_frame(int(clip->frames.size()))) break;
  }
  return clip;
}

std::shared_ptr<const Clip> played_backward(const Clip& clip) {
  auto mirrored = std::make_shared<Clip>(clip);
  const int64_t both_ticks = clip.frames.front().time.ticks + clip.frames.back().time.ticks;
  std::reverse(mirrored->frames.begin(), mirrored->frames.end());
  for (Frame& frame : mirrored->frames) {
    frame.index = clip.frames.front().index + clip.frames.back().index - frame.index;
    frame.time.ticks = both_ticks - frame.time.ticks;
  }
  std::reverse(mirrored->gyro.begin(), mirrored->gyro.end());
  for (GyroSample& sample : mirrored->gyro) {
    sample.time.ticks = both_ticks - sample.time.ticks;
    sample.rate = -sample.rate;  // accelerations are even in time
  }
  return mirrored;
}

std::shared_ptr<const Clip> with_gaps(const Clip& clip, uint64_t seed) {
  constexpr double kMissingShare = 0.3;
  constexpr size_t kEvery = 60, kFirst = 50, kInARow = 4;
  Random random = Random::derive(seed, 0x676170);
  auto left = std::make_shared<Clip>(Clip{clip.camera, clip.kind, {}, clip.gyro});
  for (size_t i = 0; i < clip.frames.size(); ++i) {
    const bool missing = random.uniform() < kMissingShare;
    const bool in_a_row = i >= kFirst && (i - kFirst) % kEvery < kInARow;
    if (i == 0 || (!missing && !in_a_row)) left->frames.push_back(clip.frames[i]);
  }
  return left;
}

GyroReadings ClipSource::gyro_readings() const {
  if (clip_->gyro.empty()) return {};
  return [clip = clip_, next = size_t(0)]() mutable -> std::optional<GyroSample> {
    if (next >= clip->gyro.size()) return std::nullopt;
    return clip->gyro[next++];
  };
}

std::vector<Timestamp> ClipSource::times() const {
  std::vector<Timestamp> times;
  for (const Frame& frame : clip_->frames) times.push_back(frame.time);
  return times;
}

std::optional<Frame> ClipSource::next() {
  if (next_ >= clip_->frames.size()) return std::nullopt;
  return clip_->frames[next_++];
}

bool ClipSource::skip() {
  if (next_ >= clip_->frames.size()) return false;
  ++next_;
  return true;
}

}  // namespace edgevo
