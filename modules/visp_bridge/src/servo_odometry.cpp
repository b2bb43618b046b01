// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/visp_bridge/servo_odometry.h"

#include <utility>

#include "edgevo/visp_bridge/conversions.h"
#include "kept_map_search.h"

namespace edgevo {
namespace {

OdometryOptions with_events(OdometryOptions options, bool are_needed) {
  if (are_needed && !options.map_log) options.map_log = std::make_shared<MapLog>();
  return options;
}

std::unique_ptr<KeptMapSearch> search_in(const Camera& camera, const OdometryOptions& options,
                                         std::shared_ptr<const PlaceStore> kept) {
  return kept ? std::make_unique<KeptMapSearch>(camera, options, std::move(kept)) : nullptr;
}

}  // namespace

ServoOdometry::ServoOdometry(const Camera& camera, const OdometryParams& params,
                             const OdometryOptions& options, ServoFeed* feed,
                             std::shared_ptr<const PlaceStore> kept)
    : ServoOdometry(camera, params, with_events(options, kept != nullptr), kept, feed) {}

ServoOdometry::ServoOdometry(const Camera& camera, const OdometryParams& params,
                             const OdometryOptions& options, std::shared_ptr<const PlaceStore> kept,
                             ServoFeed* feed)
    : feed_(feed),
      search_(search_in(camera, options, std::move(kept))),
      odometry_(camera, params, options),
      worker_({"servo"}) {}

ServoOdometry::~ServoOdometry() = default;

void ServoOdometry::push(GrayImage image, Timestamp time) {
  auto work = [this, frame = Frame{next_index_++, time, std::move(image)}]() mutable {
    try_process(std::move(frame));
  };
  if (worker_.submit_over_oldest(std::move(work))) ++replaced_;
}

void ServoOdometry::push(const vpImage<unsigned char>& image, Timestamp time) {
  push(to_gray_image(image), time);
}
void ServoOdometry::push(const vpImage<vpRGBa>& image, Timestamp time) { push(to_gray_image(image), time); }

void ServoOdometry::push_gyro(const GyroSample& sample) {
  constexpr double kKeptS = 5;  // while no frame comes
  const std::lock_guard<std::mutex> lock(gyro_mutex_);
  gyro_.push_back(sample);
  while (seconds_between(gyro_.front().time, sample.time) > kKeptS) gyro_.pop_front();
}

void ServoOdometry::add_gyro() {
  std::deque<GyroSample> samples;
  {
    const std::lock_guard<std::mutex> lock(gyro_mutex_);
    samples.swap(gyro_);
  }
  for (const GyroSample& sample : samples) odometry_.add_gyro(sample);
}

void ServoOdometry::try_process(Frame frame) {
  if (has_failed_) return;
  try {
    process(std::move(frame));
  } catch (const std::exception& e) {
    has_failed_ = true;
    feed_->fail(e.what());
  }
}

// A camera whose clock is set back must not end the loop.
void ServoOdometry::process(Frame frame) {
  const CheckedTime checked = times_.check(frame.time);
  frame.time = checked.time;
  if (!checked.problem.empty() && odometry_.newest_pose().frame_index < 0) return;
  if (!checked.problem.empty()) {
    odometry_.skip(frame, "left out: " + checked.problem);
    return;
  }
  add_gyro();
  odometry_.process(frame);
  if (search_) search_->follow();
  feed_->publish(odometry_.newest_pose(), search_ ? search_->pose(odometry_) : KeptMapPose());
}

Run ServoOdometry::finish() {
  worker_.finish();
  return odometry_.finish();
}

}  // namespace edgevo
