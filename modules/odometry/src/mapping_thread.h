#pragma once
// Runs a Mapper either in the caller (synchronous) or in a thread of its own behind a bounded queue
// (realtime).
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "edgevo/odometry/mapper.h"

namespace edgevo {

class MappingThread {
 public:
  using OnUpdate = std::function<void(const TrackedFrame&, const MapUpdate&)>;

  /// `on_update` is called after each processed frame, in the mapping thread, with no lock held.
  MappingThread(Mapper* mapper, bool own_thread, OnUpdate on_update);
  ~MappingThread();

  /// Hands a frame over. In realtime, frames that are no keyframes are left out while the queue is full;
  /// keyframes never are.
  void submit(TrackedFrame frame);
  /// Waits until all that was submitted is processed; rethrows what the mapping thread threw. Afterwards the
  /// caller may use the mapper.
  void wait_idle();
  /// A keyframe was submitted and is not processed yet.
  bool keyframe_pending() const;
  /// Waits until none is pending: a map that falls behind is waited for before it is lost.
  void wait_keyframe();
  /// The newest reference.
  std::shared_ptr<const Reference> reference() const;
  /// Takes the mapper's own reference over: after the caller has used the mapper in wait_idle's shelter.
  void refresh();
  int left_out() const { return left_out_; }

 private:
  void loop();
  void run(const TrackedFrame& frame);

  Mapper* mapper_;
  bool own_thread_;
  OnUpdate on_update_;
  mutable std::mutex mutex_;
  std::condition_variable wake_, idle_, keyframe_done_;
  std::deque<TrackedFrame> queue_;
  std::shared_ptr<const Reference> reference_;
  std::exception_ptr failure_;
  bool busy_ = false, stop_ = false;
  int keyframes_pending_ = 0;
  int left_out_ = 0;
  std::thread thread_;
};

}  // namespace edgevo
