// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The beginning of a segment: two views that make a map, the pose of that map in the world, and the poses of
// the frames that led to it.
#include <memory>
#include <optional>
#include <string>

#include "edgevo/confidence/integrity_monitor.h"
#include "edgevo/features/view_link.h"
#include "edgevo/map/frame_log.h"
#include "edgevo/mapping/bootstrap.h"
#include "edgevo/mapping/map_link.h"
#include "edgevo/tracking/backward_replay.h"
#include "edgevo/tracking/bootstrap_placement.h"
#include "edgevo/tracking/front_end.h"
#include "edgevo/tracking/located_views.h"
#include "edgevo/tracking/tracking_params.h"

namespace edgevo {

/// What links a new map to the one before (features/view_link.h); nothing without a view `before`.
inline std::optional<ViewLink> find_link(const Pinhole& pinhole,
                                         const std::optional<TrustedReference>& before,
                                         const Reference& after) {
  if (!before) return std::nullopt;
  return link_views(pinhole, before->reference->cloud, after.cloud);
}

/// A segment that has begun, as tracking needs it.
struct NewSegment {
  /// Reference that the next frames are tracked against.
  std::shared_ptr<const Reference> reference;
  /// Motion of the camera from the frame before the newest to the newest; nothing if that frame has no pose.
  std::optional<SE3> motion;
  /// Why its two views are believed (BootstrapResult::why).
  std::string why;
};

/// What a segment needs besides its map, where it was found next to the frames.
struct SegmentBeginning {
  /// Poses of the views against the new map (track_bootstrap_frames()).
  BootstrapTracks tracks;
  /// What links the map to that of the last sure view before it; nothing if nothing does.
  std::optional<ViewLink> link;
};

/// Runs bootstraps and begins segments; for the tracking thread.
class Bootstrapper {
 public:
  /// `map` and `frames` must outlive this object. `turn` may be empty.
  Bootstrapper(const Rectification& rectification, const TrackingParams& params,
               const BootstrapParams& bootstrap, uint64_t seed, MapLink* map, FrameLog* frames,
               TurnBetween turn = {});

  Bootstrapper(const Bootstrapper&) = delete;
  Bootstrapper& operator=(const Bootstrapper&) = delete;

  /// Forgets the first view.
  void reset() { bootstrap_.reset(); }
  /// Adds the next frame. Returns two views that may make a map, or why there are none yet.
  [[nodiscard]] BootstrapStatus add(const ArrivedFrame& now);
  /// Begins again with the last of these frames, before the next one: with as many as the first of them need
  /// for two views of a map. Over more, few corners are followed.
  void begin_with(const std::vector<EarlyView>& views);
  /// Rectifies the rows of the views (MapLink::rectify_rows).
  void rectify_rows(BootstrapResult* views) { map_->rectify_rows(views); }
  /// Makes a map from the two views (MapLink::make_map) and forgets them. Returns nothing, or why they make
  /// no map.
  [[nodiscard]] Reasons make_map(const BootstrapResult& views);
  /// A frame of the bootstrap has been located in a map that was kept: the next map begins there, by a motion
  /// with the turn between such frames.
  void locate(const Frame& frame, const LocatedPose& found) { located_.add(frame.index, frame.time, found); }
  /// Makes the new map that of `segment`: joins it to the segment before and gives the frames of the
  /// bootstrap their poses. `before`: the last sure view of that, which links the two maps if both see the
  /// same. `scale` is world over map, where it is known better than from equal speed; `known`: what was found
  /// already, else it is found now.
  NewSegment begin_segment(int segment, const BootstrapResult& views,
                           const std::optional<TrustedReference>& before, std::optional<double> scale,
                           const SegmentBeginning* known = nullptr);

 private:
  std::optional<CameraTurn> turn_between(Timestamp begin, Timestamp end) const;
  SegmentPlaced place(int segment, const BootstrapResult& views,
                      const std::optional<TrustedReference>& before, const std::optional<ViewLink>& link,
                      std::optional<double> scale) const;

  Pinhole pinhole_;
  Bootstrap bootstrap_;
  TrackingParams params_;
  MapLink* map_;
  FrameLog* frames_;
  TurnBetween turn_;
  LocatedViews located_;
};

}  // namespace edgevo
