#pragma once
// Hands out the frames of a source as a camera would: each when it is due. Images are read and decoded ahead
// in a thread of the feed's own, so that this does not count as the delay of whoever uses them.
//
// A recording waits: nothing of it is ever dropped, and a frame that is not fetched when it is due is handed
// out late. A live camera does not: while more than kMaxWaiting frames wait, the oldest of them is dropped,
// and the next frame that is handed out says so.
//
//   LiveFeed feed(source, parse_pace("30"));
//   while (auto fed = feed.next([] { return false; })) use(fed->frame);
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "edgevo/core/image_source.h"
#include "edgevo/datasets/pace.h"

namespace edgevo {

/// Seconds on a clock that never goes back, and waiting by it. Both are called from several threads.
class FeedClock {
 public:
  virtual ~FeedClock() = default;
  /// seconds since some moment
  virtual double now_s() const = 0;
  /// returns at once where `seconds` <= 0
  virtual void sleep_s(double seconds) = 0;
};

/// The clock of the machine.
std::shared_ptr<FeedClock> steady_clock();

/// A frame as the feed hands it out.
struct FedFrame {
  Frame frame;  ///< of the source
  double due_s = 0;     ///< of the feed's clock: when it was due. Live camera: when it came in; pace kAtOnce:
                        ///< when it was asked for and there
  double handed_s = 0;  ///< when it was handed out, due_s or later
  std::vector<Frame>
      dropped;  ///< frames that came before it and were not handed out, in order, without their images
};

/// Plays a source in time. One thread calls next().
class LiveFeed {
 public:
  static constexpr size_t kReadAhead = 4;    ///< frames of a recording that are decoded beforehand
  static constexpr size_t kMaxWaiting = 16;  ///< of a live camera; half a second at 30 frames a second

  /// Begins to read. `source` is not to be used otherwise until the feed has gone. A live camera paces
  /// itself: throws InputError for any other pace than kAtOnce.
  LiveFeed(ImageSource& source, const Pace& pace, std::shared_ptr<FeedClock> clock = steady_clock());
  /// Waits for the image that is being read.
  ~LiveFeed();

  /// Waits until the next frame is due; nullopt at the end, or when `stop` has become true meanwhile (asked
  /// every 50 ms). Throws what the source threw, after all frames before.
  std::optional<FedFrame> next(const std::function<bool()>& stop);
  /// Seconds by the clock that due_s is told in.
  double now_s() const { return clock_->now_s(); }

 private:
  struct Waiting {
    Frame frame;
    double came_s = 0;
  };

  void read_all();
  bool keep(Frame frame);
  void drop_oldest();
  bool wait_for_frame(const std::function<bool()>& stop, Waiting* waiting);
  double due_s(const Waiting& waiting);

  ImageSource& source_;
  const Pace pace_;
  const bool is_live_;
  const std::shared_ptr<FeedClock> clock_;
  int handed_out_ = 0;
  Timestamp first_time_;
  double first_due_s_ = 0;

  std::mutex mutex_;  // guards what follows
  std::condition_variable came_, room_;
  std::deque<Waiting> waiting_;
  std::vector<Frame> dropped_;
  std::exception_ptr failure_;
  bool ended_ = false, closed_ = false;
  std::thread reader_;
};

}  // namespace edgevo
