// SPDX-License-Identifier: BSD-3-Clause
#include "mapping_thread.h"

#include "edgevo/core/trace.h"

namespace edgevo {
namespace {
// Frames, a fifth of a second: beyond it only keyframes are queued, and the map stays near the camera.
constexpr size_t kMaxQueue = 6;
}  // namespace

MappingThread::MappingThread(Mapper* mapper, bool own_thread, OnUpdate on_update)
    : mapper_(mapper), own_thread_(own_thread), on_update_(std::move(on_update)) {
  if (own_thread_) thread_ = std::thread([this] { loop(); });
}

MappingThread::~MappingThread() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void MappingThread::run(const TrackedFrame& frame) {
  TraceScope traced("mapping", frame.frame_index);
  MapUpdate update;
  try {
    update = mapper_->process(frame);
    traced.set_keyframe(update.keyframe_id);
  } catch (...) {
    finish(frame);  // or a caller that goes on would wait for its keyframe for ever
    throw;
  }
  finish(frame);
  on_update_(frame, update);
}

void MappingThread::finish(const TrackedFrame& frame) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    reference_ = mapper_->reference();
    if (frame.make_keyframe) --keyframes_pending_;
  }
  keyframe_done_.notify_all();
}

void MappingThread::submit(TrackedFrame frame) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (own_thread_ && !frame.is_needed() && queue_.size() >= kMaxQueue) {
      ++skipped_;
      return;
    }
    if (frame.make_keyframe) ++keyframes_pending_;
    if (own_thread_) queue_.push_back(std::move(frame));
  }
  if (own_thread_)
    wake_.notify_one();
  else
    run(frame);
}

void MappingThread::loop() {
  name_traced_thread("mapping");
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return stop_ || !queue_.empty(); });
    if (queue_.empty()) return;
    const TrackedFrame frame = std::move(queue_.front());
    queue_.pop_front();
    busy_ = true;
    const bool failed = failure_ != nullptr;
    lock.unlock();
    std::exception_ptr failure;
    try {
      if (failed)
        finish(frame);
      else
        run(frame);
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure) failure_ = failure;
    busy_ = false;
    if (queue_.empty()) idle_.notify_all();
    if (failure_) keyframe_done_.notify_all();
  }
}

void MappingThread::wait_idle() {
  if (!own_thread_) return;
  const TraceScope traced("wait for mapping");
  std::unique_lock<std::mutex> lock(mutex_);
  idle_.wait(lock, [this] { return queue_.empty() && !busy_; });
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

bool MappingThread::keyframe_pending() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return keyframes_pending_ > 0;
}

void MappingThread::wait_keyframe(std::chrono::milliseconds at_most) {
  const TraceScope traced("wait for a keyframe");
  std::unique_lock<std::mutex> lock(mutex_);
  keyframe_done_.wait_for(lock, at_most, [this] { return keyframes_pending_ == 0 || failure_; });
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
