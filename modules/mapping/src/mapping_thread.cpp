// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/mapping_thread.h"

#include <utility>

#include "edgevo/core/trace.h"

namespace edgevo {
namespace {
// Frames, a fifth of a second: beyond it only keyframes are queued, and the map stays near the camera.
constexpr size_t kMaxQueue = 6;
}  // namespace

MappingThread::MappingThread(Mapper* mapper, bool own_thread, OnUpdate on_update)
    : mapper_(mapper), on_update_(std::move(on_update)), worker_({"mapping", kMaxQueue, own_thread}) {}

void MappingThread::run(const TrackedFrame& frame) {
  TraceScope traced("mapping", frame.frame_index);
  MapUpdate update;
  try {
    update = mapper_->process(frame);
    traced.set_keyframe(update.keyframe_id);
  } catch (...) {
    finish(frame, true);  // or a caller that goes on would wait for its keyframes
    throw;
  }
  finish(frame, false);
  on_update_(frame, update);
}

void MappingThread::finish(const TrackedFrame& frame, bool has_failed) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    reference_ = mapper_->reference();
    if (frame.make_keyframe) --keyframes_pending_;
    has_failed_ |= has_failed;
  }
  keyframe_done_.notify_all();
}

void MappingThread::submit(TrackedFrame frame) {
  const bool is_needed = frame.is_needed();
  if (frame.make_keyframe) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!has_failed_) ++keyframes_pending_;
  }
  auto work = [this, mapped = std::move(frame)] { run(mapped); };
  if (is_needed)
    worker_.submit(std::move(work));
  else if (!worker_.submit_if_room(std::move(work)))
    ++skipped_;
}

void MappingThread::wait_idle() {
  const TraceScope traced("wait for mapping");
  worker_.wait_idle();
}

bool MappingThread::keyframe_pending() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return keyframes_pending_ > 0;
}

void MappingThread::wait_keyframe(std::chrono::milliseconds at_most) {
  const TraceScope traced("wait for a keyframe");
  std::unique_lock<std::mutex> lock(mutex_);
  keyframe_done_.wait_for(lock, at_most, [this] { return keyframes_pending_ == 0 || has_failed_; });
}

std::shared_ptr<const Reference> MappingThread::reference() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return reference_;
}

void MappingThread::refresh() {
  const std::lock_guard<std::mutex> lock(mutex_);
  reference_ = mapper_->reference();
}

}  // namespace edgevo
