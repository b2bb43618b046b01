// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Runs a Mapper either in the caller's thread (synchronous) or in a thread of its own behind a bounded queue
// (realtime).
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>

#include "edgevo/core/worker.h"
#include "edgevo/mapping/mapper.h"

namespace edgevo {

/// Feeds a Mapper and holds its newest reference.
class MappingThread {
 public:
  /// Called with each processed frame.
  using OnUpdate = std::function<void(const TrackedFrame&, const MapUpdate&)>;

  /// `on_update` is called in the mapping thread, with no lock held.
  MappingThread(Mapper* mapper, bool own_thread, OnUpdate on_update);

  /// Passes a frame to the mapper. In realtime, frames other than keyframes are skipped while the queue is
  /// full; keyframes never are. Rethrows what the mapping thread threw, once: no frame is mapped after that.
  void submit(TrackedFrame frame);
  /// Waits until all submitted frames are processed; rethrows as submit() does. Afterwards the caller may use
  /// the mapper.
  void wait_idle();
  /// True while a submitted keyframe is not processed.
  bool keyframe_pending() const;
  /// Waits until no keyframe is pending, at most that long: better to wait for a map that falls behind than
  /// to lose it.
  void wait_keyframe(std::chrono::milliseconds at_most);
  /// The newest reference; null without a map.
  std::shared_ptr<const Reference> reference() const;
  /// Adopts the mapper's reference after the caller has used the mapper (see wait_idle()).
  void refresh();
  /// Frames that were skipped because the queue was full.
  int skipped() const { return skipped_; }

 private:
  void run(const TrackedFrame& frame);
  // Publishes the reference after a frame, processed or not.
  void finish(const TrackedFrame& frame, bool has_failed);

  Mapper* mapper_;
  OnUpdate on_update_;
  int skipped_ = 0;
  mutable std::mutex mutex_;  // guards what follows
  std::condition_variable keyframe_done_;
  std::shared_ptr<const Reference> reference_;
  int keyframes_pending_ = 0;
  bool has_failed_ = false;
  Worker worker_;  // last member: it ends before the others
};

}  // namespace edgevo
