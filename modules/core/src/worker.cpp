// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/worker.h"

#include "edgevo/core/thread_priority.h"
#include "edgevo/core/trace.h"

namespace edgevo {

Worker::Worker(const WorkerOptions& options) : options_(options), queue_(options.max_waiting) {
  if (options_.own_thread) thread_ = std::thread([this] { loop(); });
}

Worker::~Worker() {
  if (options_.drops_at_end) {
    const std::lock_guard<std::mutex> lock(mutex_);
    drops_ = true;
  }
  end_thread();
}

void Worker::end_thread() {
  queue_.close();
  if (thread_.joinable()) thread_.join();
}

void Worker::finish() {
  end_thread();
  const std::lock_guard<std::mutex> lock(mutex_);
  rethrow();
}

template <typename Add>
bool Worker::submit_by(Work work, Add add) {
  if (!options_.own_thread) {
    work();
    return true;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    rethrow();
    ++unfinished_;
  }
  const bool is_added = add(std::move(work));
  if (!is_added) finished_one();
  return is_added;
}

void Worker::submit(Work work) {
  submit_by(std::move(work), [this](Work w) { return queue_.push(std::move(w)); });
}

bool Worker::submit_if_room(Work work) {
  return submit_by(std::move(work), [this](Work w) { return queue_.push_if_room(std::move(w)); });
}

void Worker::submit_when_room(Work work) {
  submit_by(std::move(work), [this](Work w) { return queue_.push_when_room(std::move(w)); });
}

bool Worker::submit_over_oldest(Work work) {
  std::optional<Work> oldest;
  submit_by(std::move(work), [&](Work w) { return queue_.push_over_oldest(std::move(w), &oldest); });
  if (oldest) finished_one();
  return oldest.has_value();
}

void Worker::wait_idle() {
  std::unique_lock<std::mutex> lock(mutex_);
  idle_.wait(lock, [this] { return unfinished_ == 0; });
  rethrow();
}

bool Worker::is_idle() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return unfinished_ == 0;
}

void Worker::loop() {
  name_traced_thread(options_.name);
  if (options_.low_priority) lower_thread_priority();
  while (const std::optional<Work> work = queue_.pop()) {
    execute(*work);
    finished_one();
  }
}

void Worker::execute(const Work& work) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (drops_) return;
  }
  try {
    work();
  } catch (...) {
    const std::lock_guard<std::mutex> lock(mutex_);
    failure_ = std::current_exception();
    drops_ = true;
  }
}

void Worker::finished_one() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (--unfinished_ == 0) idle_.notify_all();
}

void Worker::rethrow() {
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

}  // namespace edgevo
