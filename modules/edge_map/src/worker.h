// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs work in the caller, or in a thread of its own behind a bounded queue.
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace edgevo {

/// Executes functions in order.
class Worker {
 public:
  Worker(bool own_thread, size_t max_waiting);
  ~Worker();

  /// Runs or queues `work`; skips it if `max_waiting` pieces of work are queued already.
  void submit(std::function<void()> work);
  /// Waits until all work is done; rethrows an exception of the work.
  void wait_idle();
  /// Whether wait_idle() would not wait.
  bool is_idle();
  /// Number of skipped pieces of work.
  int skipped() const { return skipped_; }

 private:
  void loop();

  const bool own_thread_;
  const size_t max_waiting_;
  std::mutex mutex_;
  std::condition_variable wake_, idle_;
  std::deque<std::function<void()>> queue_;
  std::exception_ptr failure_;
  bool busy_ = false, stop_ = false;
  int skipped_ = 0;  // used by the caller's thread only
  std::thread thread_;
};

}  // namespace edgevo
