// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Delivers the frames of a source as a camera would: each when it is due. Images are read and decoded ahead
// in a separate thread, so that decoding does not count towards the latency of the consumer.
//
// A recording waits: none of its frames is ever dropped, and a frame that is not fetched when it is due is
// delivered late. A live camera does not wait: while more than kMaxWaiting frames are queued, the oldest is
// dropped, and the next frame delivered lists it.
//
//   LiveFeed feed(source, parse_pace("30"));
//   while (auto fed = feed.next([] { return false; })) use(fed->frame);
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "edgevo/core/bounded_queue.h"
#include "edgevo/core/image_source.h"
#include "edgevo/core/worker.h"
#include "edgevo/datasets/pace.h"

namespace edgevo {

/// A monotonic clock to read and to wait on. Called from several threads.
class FeedClock {
 public:
  virtual ~FeedClock() = default;
  /// Seconds since an arbitrary moment.
  virtual double now_s() const = 0;
  /// Waits for `seconds`; returns at once if that is <= 0.
  virtual void sleep_s(double seconds) = 0;
};

/// The machine's monotonic clock.
std::shared_ptr<FeedClock> steady_clock();

/// A frame as delivered by the feed.
struct FedFrame {
  /// The frame of the source.
  Frame frame;
  /// Time at which the frame was due, seconds of the feed's clock. Live camera: when it arrived; pace
  /// kAtOnce: when it was both requested and available.
  double due_s = 0;
  /// Time at which the frame was delivered, seconds of the feed's clock, due_s or later.
  double delivered_s = 0;
  /// Frames before this one that were not delivered, in order, without their images.
  std::vector<Frame> dropped;
};

/// Plays a source in real time. One thread calls next().
class LiveFeed {
 public:
  /// Number of frames of a recording decoded in advance.
  static constexpr size_t kReadAhead = 4;
  /// Queue length for a live camera, frames: half a second at 30 frames/s.
  static constexpr size_t kMaxWaiting = 16;

  /// Starts reading. `source` must not be used otherwise while the feed exists. A live camera paces itself:
  /// throws InputError for any pace other than kAtOnce.
  LiveFeed(ImageSource& source, const Pace& pace, std::shared_ptr<FeedClock> clock = steady_clock());
  /// Waits until the image being read is complete.
  ~LiveFeed();

  /// Waits until the next frame is due; nullopt at the end, or once `stop` returns true (polled every 50 ms).
  /// Rethrows an exception of the source after all frames before it.
  std::optional<FedFrame> next(const std::function<bool()>& stop);
  /// Current time in seconds, on the clock of due_s.
  double now_s() const { return clock_->now_s(); }

 private:
  struct Waiting {
    Frame frame;
    double came_s = 0;
  };

  void read_all();
  std::optional<Frame> read();
  bool keep(Frame frame);
  void keep_newest(Waiting waiting);
  std::optional<Waiting> wait_for_frame(const std::function<bool()>& stop);
  std::vector<Frame> dropped_before(int index);
  double due_s(const Waiting& waiting);

  ImageSource& source_;
  const Pace pace_;
  const bool is_live_;
  const std::shared_ptr<FeedClock> clock_;
  int delivered_ = 0;
  Timestamp first_time_;
  double first_due_s_ = 0;

  BoundedQueue<Waiting> waiting_;  // closed when either side has ended
  std::mutex dropping_;            // guards dropped_
  std::vector<Frame> dropped_;
  Worker reader_;  // last member: it ends before the others
};

}  // namespace edgevo
