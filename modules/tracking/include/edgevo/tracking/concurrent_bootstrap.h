// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The bootstrap next to the frames: an attempt to find two views takes up to 0.1 s, and the first map as long
// again, while the frames of a camera go on arriving. One thread besides the caller's does both.
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "edgevo/core/worker.h"
#include "edgevo/mapping/bootstrap.h"
#include "edgevo/mapping/map_link.h"
#include "edgevo/segmentation/ego_mask_monitor.h"
#include "edgevo/tracking/bootstrapper.h"
#include "edgevo/tracking/frame_buffer.h"
#include "edgevo/tracking/tracking_params.h"

namespace edgevo {

/// A map that was made of two views, if it was.
struct MadeMap {
  /// Why the views make no map; empty if they do.
  Reasons problem;
  /// The views.
  BootstrapResult views;
  /// What its segment needs besides.
  SegmentBeginning beginning;
};

/// Searches two views, then makes a map of them, and keeps the frames that arrive meanwhile; for the tracking
/// thread, which never waits except in take_map() and the destructor.
class ConcurrentBootstrap {
 public:
  /// `map` must outlive this object.
  ConcurrentBootstrap(const Rectification& rectification, const TrackingParams& params,
                      const BootstrapParams& bootstrap, uint64_t seed, MapLink* map);
  /// Forgets the views, also those under way. A map in the making goes on.
  void reset();
  /// Gives the next frame to the search. Returns why there is no map yet, as known now: a search that is
  /// behind tries only some frames, and one that is far behind loses the oldest. Begins to make a map
  /// once there are two views (MapLink::make_map), unless `ego_mask_monitor` delays it, and looks for what
  /// links it to `before`, the last sure view of the map before; until take_map() the caller must not use the
  /// MapLink. With the frame comes where it was `located` in a kept map; none begins while it
  /// `may_be_located` yet.
  BootstrapStatus look(const ArrivedFrame& now, EgoMaskMonitor& ego_mask_monitor,
                       const std::optional<TrustedReference>& before,
                       const std::optional<LocatedPose>& located = {}, bool may_be_located = false);
  /// Keeps a frame that arrives while frames_wait().
  void keep(const ArrivedFrame& now) { late_.add(now); }

  /// True from the beginning of a map until take_map().
  bool is_making() const { return making_.valid(); }
  /// True if take_map() need not wait.
  bool is_made() const;
  /// The map; rethrows what making it threw. Without a problem the late frames are to be followed.
  MadeMap take_map();

  /// Whether there is a map for frames that arrived before it was there.
  bool catches_up() const { return catches_up_ && !late_.empty(); }
  /// Frames that are followed in the time of one.
  static constexpr int kReplayedAtOnce = 3;
  /// The oldest of them, once.
  BufferedFrame take_buffered() { return late_.take(); }
  /// They get no poses.
  void drop_buffered() { late_.clear(); }
  /// Whether a frame that arrives now must wait.
  bool frames_wait() const { return is_making() || catches_up(); }

 private:
  struct Waiting {
    int frame_index;
    Timestamp time;
    std::shared_ptr<const FramePyramid> pyramid;
    ImageMotion rows;  // for which they have been rectified
    std::optional<LocatedPose> located;
  };
  struct Search {
    Waiting frame;
    bool attempt, after_reset;
  };
  void add(Waiting frame);
  // Takes the next frame that waits, if the search does not rest.
  std::optional<Search> next();
  void search_next();
  BootstrapStatus poll();
  void resume();
  int searched_until() const;
  void begin_map(BootstrapResult views, std::optional<TrustedReference> before);
  MadeMap make_map(BootstrapResult views, const std::optional<TrustedReference>& before);

  Pinhole pinhole_;
  TrackingParams params_;
  MapLink* map_;
  // Frames after those that are known not to end in a map, oldest first.
  FrameBuffer late_;
  bool catches_up_ = false;
  // Of the searching thread.
  LocatedViews located_;
  Bootstrap bootstrap_;
  int followed_ = 0;          // frames since the last attempt
  mutable std::mutex mutex_;  // guards what follows, up to making_
  std::deque<Waiting> queue_;
  BootstrapStatus status_;   // the search rests once it has a result
  int searched_until_ = -1;  // index of a frame
  bool rests_ = false, is_reset_ = false;
  std::future<MadeMap> making_;
  Worker worker_;  // last member: it ends before the others
};

}  // namespace edgevo
