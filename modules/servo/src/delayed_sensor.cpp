// SPDX-License-Identifier: BSD-3-Clause
#include "delayed_sensor.h"

#include <algorithm>
#include <chrono>

#include "edgevo/core/thread_clock.h"
#include "edgevo/detectors/all_detectors.h"

namespace edgevo {
namespace {

OdometryOptions options_of(const ServoParams& servo) {
  OdometryOptions options;
  options.seed = servo.seed;
  options.detectors = all_edge_detectors();
  return options;
}

// Duration of `work`, in CPU time or wall-clock time.
template <class Work>
double seconds_of(bool cpu, const Work& work) {
  const double cpu_begin_ms = thread_cpu_ms();
  const auto begin = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  return cpu ? 1e-3 * (thread_cpu_ms() - cpu_begin_ms) : took.count();
}

}  // namespace

DelayedSensor::DelayedSensor(const Camera& camera, const OdometryParams& params, const ServoParams& servo,
                             ServoFeed* feed)
    : odometry_(camera, params, options_of(servo)),
      given_latency_s_(servo.latency_s),
      cpu_latency_(servo.cpu_latency),
      feed_(feed) {}

void DelayedSensor::push(Frame frame) {
  if (waiting_) ++replaced_;
  waiting_ = std::move(frame);
}

void DelayedSensor::advance(double until_s, std::vector<ServoRow>* rows) {
  if (waiting_ && std::max(free_at_s_, waiting_->time.seconds()) < until_s) work(rows);
  while (!ready_.empty() && ready_.front().first <= until_s) {
    feed_->publish(ready_.front().second);
    ready_.pop_front();
  }
}

void DelayedSensor::work(std::vector<ServoRow>* rows) {
  const Frame frame = std::move(*waiting_);
  waiting_.reset();
  const double took_s = seconds_of(cpu_latency_, [&] { odometry_.process(frame); });
  free_at_s_ = std::max(free_at_s_, frame.time.seconds()) + given_latency_s_.value_or(took_s);
  ready_.emplace_back(free_at_s_, odometry_.newest_pose());
  (*rows)[size_t(frame.index)].latency_s = free_at_s_ - frame.time.seconds();
}

}  // namespace edgevo
