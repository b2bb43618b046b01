// SPDX-License-Identifier: BSD-3-Clause
#include "worker.h"

#include <utility>

#include "edgevo/core/thread_priority.h"
#include "edgevo/core/trace.h"

namespace edgevo {

Worker::Worker(bool own_thread, size_t max_waiting) : own_thread_(own_thread), max_waiting_(max_waiting) {
  if (own_thread_) thread_ = std::thread([this] { loop(); });
}

Worker::~Worker() {
  if (!own_thread_) return;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
    queue_.clear();
  }
  wake_.notify_all();
  thread_.join();
}

void Worker::submit(std::function<void()> work) {
  if (!own_thread_) return work();
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (queue_.size() >= max_waiting_) {
      ++skipped_;
      return;
    }
    queue_.push_back(std::move(work));
  }
  wake_.notify_one();
}

void Worker::wait_idle() {
  if (!own_thread_) return;
  std::unique_lock<std::mutex> lock(mutex_);
  idle_.wait(lock, [this] { return queue_.empty() && !busy_; });
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

bool Worker::is_idle() {
  if (!own_thread_) return true;
  const std::lock_guard<std::mutex> lock(mutex_);
  return queue_.empty() && !busy_;
}

void Worker::loop() {
  name_traced_thread("lines of edges");
  // Tracking and mapping have priority; this thread skips work when it is behind.
  lower_thread_priority();
  std::unique_lock<std::mutex> lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return stop_ || !queue_.empty(); });
    if (stop_) return;
    const std::function<void()> work = std::move(queue_.front());
    queue_.pop_front();
    busy_ = true;
    lock.unlock();
    std::exception_ptr failure;
    try {
      const TraceScope traced("lines of a keyframe");
      work();
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    if (failure) failure_ = failure;
    busy_ = false;
    if (queue_.empty()) idle_.notify_all();
  }
}

}  // namespace edgevo
