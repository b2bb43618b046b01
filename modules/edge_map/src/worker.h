#pragma once
// Work done in the caller, or in a thread of its own behind a bounded queue.
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace edgevo {

class Worker {
 public:
  Worker(bool own_thread, size_t max_waiting);
  ~Worker();

  /// Left out where the thread has `max_waiting` pieces of work before it.
  void submit(std::function<void()> work);
  /// Until all is done; rethrows what the work threw.
  void wait_idle();
  int left_out() const { return left_out_; }

 private:
  void loop();

  const bool own_thread_;
  const size_t max_waiting_;
  std::mutex mutex_;
  std::condition_variable wake_, idle_;
  std::deque<std::function<void()>> queue_;
  std::exception_ptr failure_;
  bool busy_ = false, stop_ = false;
  int left_out_ = 0;  // the caller's
  std::thread thread_;
};

}  // namespace edgevo
