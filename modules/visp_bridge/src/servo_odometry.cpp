// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/visp_bridge/servo_odometry.h"

#include "edgevo/visp_bridge/conversions.h"

namespace edgevo {

ServoOdometry::ServoOdometry(const Camera& camera, const OdometryParams& params,
                             const OdometryOptions& options, ServoFeed* feed)
    : feed_(feed), odometry_(camera, params, options), thread_([this] { loop(); }) {}

ServoOdometry::~ServoOdometry() { stop(); }

void ServoOdometry::push(GrayImage image, Timestamp time) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_) ++replaced_;
    waiting_ = Frame{next_index_++, time, std::move(image)};
  }
  wake_.notify_one();
}

void ServoOdometry::push(const vpImage<unsigned char>& image, Timestamp time) {
  push(to_gray_image(image), time);
}
void ServoOdometry::push(const vpImage<vpRGBa>& image, Timestamp time) { push(to_gray_image(image), time); }

int ServoOdometry::replaced() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return replaced_;
}

void ServoOdometry::loop() {
  for (;;) {
    std::unique_lock<std::mutex> lock(mutex_);
    wake_.wait(lock, [this] { return stop_ || waiting_; });
    if (!waiting_) return;
    Frame frame = std::move(*waiting_);
    waiting_.reset();
    lock.unlock();
    try {
      process(std::move(frame));
    } catch (const std::exception& e) {
      feed_->fail(e.what());
      return;
    }
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
  odometry_.process(frame);
  feed_->publish(odometry_.newest_pose());
}

void ServoOdometry::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

Run ServoOdometry::finish() {
  stop();
  return odometry_.finish();
}

}  // namespace edgevo
