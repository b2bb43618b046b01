// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Files written next to the frames: a disk that is busy holds a write up for 0.1 s.
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace edgevo {

/// Runs tasks one after the other in a thread of its own.
class WriterThread {
 public:
  WriterThread();
  /// Waits for all tasks; what they throw is lost.
  ~WriterThread();
  WriterThread(const WriterThread&) = delete;
  WriterThread& operator=(const WriterThread&) = delete;

  /// Adds a task. Waits while kMax tasks are waiting: a disk that is too slow for long holds the run up.
  /// Throws what an earlier task has thrown, once; after that no task runs.
  void post(std::function<void()> task);
  /// Waits for all tasks. Throws like post().
  void wait();

  /// Tasks that may wait: two a frame, so a second of a camera.
  static constexpr size_t kMax = 60;

 private:
  void loop();
  void rethrow();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> tasks_;
  bool busy_ = false, stop_ = false, failed_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace edgevo
