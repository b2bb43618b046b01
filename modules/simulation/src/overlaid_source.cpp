// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/overlaid_source.h"

#include <utility>

#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

constexpr double kTypicalStep = 0.1;  // seconds, of a source that does not know its times beforehand

double typical_step(const std::vector<Timestamp>& times) {
  std::vector<double> steps;
  for (size_t i = 1; i < times.size(); ++i) steps.push_back(seconds_between(times[i - 1], times[i]));
  return steps.empty() ? kTypicalStep : median(std::move(steps));
}

}  // namespace

OverlaidSource::OverlaidSource(std::unique_ptr<ImageSource> source, const OverlayOptions& options)
    : WrappedSource(std::move(source)),
      overlay_(options, inner().camera().pinhole().width, inner().camera().pinhole().height),
      step_s_(typical_step(inner().times())) {}

std::optional<int> OverlaidSource::size() const {
  const std::optional<int> frames = inner().size();
  return frames ? std::optional<int>(*frames + overlay_.options().standing) : frames;
}

std::vector<Timestamp> OverlaidSource::times() const {
  return overlay_.options().standing > 0 ? std::vector<Timestamp>() : inner().times();
}

std::optional<Frame> OverlaidSource::next_real() {
  std::optional<Frame> frame = inner().next();
  if (!frame) return frame;
  if (!begin_) begin_ = frame->time;
  const OverlayOptions& options = overlay_.options();
  if (options.standing > 0 && read_++ == options.stop_at) stopped_ = frame;
  return frame;
}

Frame OverlaidSource::finish(Frame frame, std::optional<int> standing) {
  const OverlayOptions& options = overlay_.options();
  if (options.standing > 0) {
    frame.image_path.clear();
    frame.index = written_;
    frame.time.ticks += Timestamp::from_seconds(step_s_).ticks * stood_;
  }
  ++written_;
  OverlaidImage out =
      overlay_.apply(frame.image, frame.index, seconds_between(*begin_, frame.time), standing);
  frame.image = std::move(out.image);
  moving_ = std::move(out.moving);
  return frame;
}

std::optional<Frame> OverlaidSource::next() {
  if (stopped_ && stood_ < overlay_.options().standing) {
    ++stood_;
    return finish(*stopped_, stood_ - 1);
  }
  std::optional<Frame> frame = next_real();
  if (!frame) return frame;
  return finish(std::move(*frame), std::nullopt);
}

GrayImage OverlaidSource::moving_mask() const {
  const Pinhole p = camera().pinhole();
  return {p.width, p.height,
          moving_.empty() ? std::vector<uint8_t>(size_t(p.width) * p.height, 255) : moving_};
}

GrayImage OverlaidSource::own_part_mask() const {
  const Pinhole p = camera().pinhole();
  return overlay_.own_part_mask().empty() ? GrayImage{}
                                          : GrayImage{p.width, p.height, overlay_.own_part_mask()};
}

std::string OverlaidSource::ground_truth(const std::string& tum) const {
  if (!stopped_ || tum.empty()) return tum;
  return ground_truth_with_stop(tum, stopped_->time, step_s_, overlay_.options().standing);
}

}  // namespace edgevo
