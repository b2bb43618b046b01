// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Work next to the frames, in order: behind a bounded queue, in a thread of its own or in the caller's.
#include <condition_variable>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>

#include "edgevo/core/bounded_queue.h"

namespace edgevo {

/// How a Worker works.
struct WorkerOptions {
  /// Of its lane in a trace; a literal.
  const char* name = "";
  /// Pieces of work that may wait; submit() adds more.
  size_t max_waiting = 1;
  /// Otherwise each piece is done by the caller that submits it, and what it throws is thrown there.
  bool own_thread = true;
  /// Its thread waits for those that a pose waits for (lower_thread_priority()).
  bool low_priority = false;
  /// The destructor waits for the piece under way alone, not for what is still to be done.
  bool drops_at_end = false;
};

/// Does pieces of work one after another. With a thread of its own, a piece that throws is the last one done:
/// what it threw is rethrown once, by the next submit...(), wait_idle() or finish(), and all work after it is
/// dropped.
class Worker {
 public:
  /// A piece of work.
  using Work = std::function<void()>;

  /// Begins its thread, if it has one.
  explicit Worker(const WorkerOptions& options);
  /// Does the work that waits (see drops_at_end); what that throws is lost.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// Adds work, however much waits.
  void submit(Work work);
  /// Adds work unless too much waits; false then.
  bool submit_if_room(Work work);
  /// Adds work; waits while too much of it waits.
  void submit_when_room(Work work);
  /// Adds work; drops the oldest that waits if too much does. True if it has.
  bool submit_over_oldest(Work work);
  /// Adds work with a result. What it throws is thrown by the result alone; work that is dropped leaves the
  /// result with std::future_error.
  template <typename Function>
  std::future<std::invoke_result_t<Function&>> begin(Function function) {
    using Result = std::invoke_result_t<Function&>;
    const auto task = std::make_shared<std::packaged_task<Result()>>(std::move(function));
    std::future<Result> result = task->get_future();
    submit([task] { (*task)(); });
    return result;
  }

  /// Waits until all work is done.
  void wait_idle();
  /// Does the work that waits and ends the thread; what is submitted from now on is dropped.
  void finish();
  /// Whether wait_idle() would not wait.
  bool is_idle() const;

 private:
  // Adds work by `add`, a method of the queue that returns whether it now waits.
  template <typename Add>
  bool submit_by(Work work, Add add);
  void loop();
  void end_thread();
  void execute(const Work& work);
  void finished_one();
  void rethrow();

  const WorkerOptions options_;
  BoundedQueue<Work> queue_;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable idle_;
  size_t unfinished_ = 0;  // waiting and under way
  std::exception_ptr failure_;
  bool drops_ = false;  // what waits
  std::thread thread_;
};

}  // namespace edgevo
