// SPDX-License-Identifier: BSD-3-Clause
#include "first_look.h"

#include <exception>
#include <memory>
#include <variant>

#include "edgevo/core/rectification.h"
#include "edgevo/core/trace.h"
#include "edgevo/map/map_log.h"
#include "edgevo/run_loop/gyro_feed.h"
#include "lenient_source.h"

namespace edgevo {
namespace {

// Three seconds of most cameras: rows that bend show within.
constexpr int kMostLookedAt = 90;
// That are kept for it: ninety images of four megapixels.
constexpr size_t kMostBytes = 400'000'000;

bool is_rolling(const CameraPosterior& camera) {
  return camera.state_of(CameraNumber::kReadout) == CameraPosterior::State::kApplied;
}

// A read-out time has converged by the first estimate of k1. Where the estimate before shows none, the rows
// are straight, or bend too little to matter.
bool is_decided(const CameraPosterior& camera, int min_keyframes) {
  return camera.given.keyframes >= (is_rolling(camera) ? min_keyframes : min_keyframes / 2);
}

// The smallest half, quarter or less of an image that shows by how much its rows bend: VGA halved finds a
// read-out time of 20 to 30 ms as well as the whole image does, and a quarter of it takes it for none.
Pinhole at_a_glance(const Pinhole& whole) {
  constexpr int kEnoughPixels = 320 * 240;
  int level = 0;
  const auto pixels = [&](int at) { return whole.at_level(at).width * whole.at_level(at).height; };
  while (pixels(level + 1) >= kEnoughPixels) ++level;
  return whole.at_level(level);
}

class FrameFollower {
 public:
  FrameFollower(FirstFrames* source, const OdometryParams& params, const OdometryOptions& options)
      : frames_(*source),
        gyro_(source->gyro_readings()),
        odometry_(source->camera(), params, options),
        events_(options.map_log),
        min_keyframes_(params.camera.min_keyframes) {}

  // Returns whether a further frame is of use.
  bool follow_next() {
    const std::optional<Frame> frame = frames_.next();
    if (!frame) return false;
    if (frame->image.empty()) {
      odometry_.skip(*frame, frames_.take_reason(frame->index));
    } else {
      gyro_.feed_until(frame->time, &odometry_);
      odometry_.process(*frame);
    }
    for (const std::shared_ptr<const MapEvent>& event : events_.read())
      if (const auto* found = std::get_if<CameraEstimated>(event.get())) camera_ = found->camera;
    return !is_decided(camera_, min_keyframes_);
  }
  const CameraPosterior& camera() const { return camera_; }

 private:
  LenientSource frames_;
  GyroFeed gyro_;
  Odometry odometry_;
  MapCursor events_;
  int min_keyframes_;
  CameraPosterior camera_;
};

}  // namespace

bool takes_first_look(const ImageSource& source, const OdometryParams& params,
                      const OdometryOptions& options) {
  const bool is_to_be_found = params.camera.refines_readout() && params.camera.readout_s == 0;
  return is_to_be_found && !options.on_schedule && !source.is_live() && bool(source.gyro_readings());
}

std::optional<CameraPosterior> first_look(FirstFrames* source, OdometryParams params, OdometryOptions options,
                                          const std::function<bool()>& stop) {
  const TraceScope traced("first look");
  options.map_log = std::make_shared<MapLog>();
  options.log = {};
  options.realtime = false;
  options.move_map = {};
  params.edge_map.mode = "off";
  options.working_pinhole = at_a_glance(rectification_of(source->camera(), options).target());
  source->keep();
  std::optional<CameraPosterior> found;
  try {
    FrameFollower look(source, params, options);
    for (int i = 0; i < kMostLookedAt && source->kept_bytes() < kMostBytes && !stop() && look.follow_next();
         ++i) {
    }
    if (is_rolling(look.camera())) found = look.camera();
  } catch (const std::exception&) {
    // The run itself comes to the same frame, and says what is wrong with it.
  }
  source->read_again();
  return found;
}

}  // namespace edgevo
