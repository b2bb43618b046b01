// SPDX-License-Identifier: BSD-3-Clause
#include "delayed_sensor.h"

#include <algorithm>
#include <chrono>

#include "edgevo/core/thread_clock.h"
#include "edgevo/detectors/all_detectors.h"

namespace edgevo {
namespace {

OdometryOptions options_of(const ServoParams& servo, std::shared_ptr<MapLog> log) {
  OdometryOptions options;
  options.map_log = std::move(log);
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
                             ServoFeed* feed, std::shared_ptr<const PlaceStore> kept)
    : events_(log_),
      in_kept_(kept ? std::optional<KeptMapTracker>(kept) : std::nullopt),
      past_(camera, std::nullopt, options_of(servo, log_), past_params(std::move(kept))),
      odometry_(camera, params, options_of(servo, log_)),
      given_latency_s_(servo.latency_s),
      cpu_latency_(servo.cpu_latency),
      feed_(feed) {}

PastParams DelayedSensor::past_params(std::shared_ptr<const PlaceStore> kept) {
  PastParams past;
  past.kept = std::move(kept);
  past.looks_up_young = true;
  past.on_stored = [this](const StoredKeyframe& k) { keyframes_.push_back(k); };
  return past;
}

void DelayedSensor::push(Frame frame) {
  if (waiting_) ++replaced_;
  waiting_ = std::move(frame);
}

void DelayedSensor::advance(double until_s, std::vector<ServoRow>* rows) {
  if (waiting_ && std::max(free_at_s_, waiting_->time.seconds()) < until_s) work(rows);
  while (!ready_.empty() && ready_.front().time_s <= until_s) {
    feed_->publish(ready_.front().pose, ready_.front().kept);
    ready_.pop_front();
  }
}

void DelayedSensor::work(std::vector<ServoRow>* rows) {
  const Frame frame = std::move(*waiting_);
  waiting_.reset();
  KeptMapPose kept;
  const double took_s = seconds_of(cpu_latency_, [&] {
    odometry_.process(frame);
    if (in_kept_) kept = in_kept_->follow(odometry_, found_.contains(odometry_.newest_pose().segment));
  });
  past_.follow();
  for (const auto& event : events_.read()) found_.apply(*event);
  free_at_s_ = std::max(free_at_s_, frame.time.seconds()) + given_latency_s_.value_or(took_s);
  const NewestPose newest = odometry_.newest_pose();
  ready_.push_back({free_at_s_, newest, kept});
  (*rows)[size_t(frame.index)].latency_s = free_at_s_ - frame.time.seconds();
}

KeptLoop DelayedSensor::finish() {
  odometry_.close();
  past_.finish();
  KeptLoop kept;
  kept.run = odometry_.finish();
  kept.keyframes = std::move(keyframes_);
  return kept;
}

}  // namespace edgevo
