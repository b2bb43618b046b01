// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Relates the units of length of a run's epochs (map/epochs.h) by the camera's height over the ground
// (ground_height.h): for vehicles, whose height does not change. It averages over many keyframes, where
// features compare two views.
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "edgevo/map/map_event.h"
#include "edgevo/map/map_log.h"
#include "edgevo/scale/ground_height.h"
#include "edgevo/scale/path.h"
#include "edgevo/scale/scale_estimate.h"
#include "edgevo/scale/scale_params.h"

namespace edgevo {

/// Follows a run, and adds constraints between its epochs to the log of its events. For one thread; memory:
/// the last hundred keyframes of each epoch. Cost: nothing while a run has one epoch; then about 50 us for
/// each of a hundred keyframes, each time that twice as many have been seen.
class GroundLinks {
 public:
  /// `T_vehicle_cam`: mount of the camera, if known. `log`, not null: that whose events are followed.
  GroundLinks(const Pinhole& pinhole, const std::optional<SE3>& T_vehicle_cam, const ScaleParams& params,
              std::shared_ptr<MapLog> log);

  /// Takes the next event of the run.
  void apply(const MapEvent& event);

 private:
  struct Seen {  // a keyframe in its segment's map
    int id = 0;
    std::shared_ptr<const KeyframeRecord> record;
    double height_ratio = 1;  // of its points now, over those of the record: the map has moved
  };
  struct Part {  // an epoch
    int segment = 0, first_keyframe = -1;
    std::deque<Seen> keyframes;           // marginalised, oldest first
    std::optional<ScaleEstimate> height;  // reciprocal of the height, once it has ended
    int last_keyframe = 0;                // of those that it was measured from
    size_t marginalised = 0;              // keyframes so far, forgotten ones included
    size_t due = 1;                       // keyframes at which it is measured next
    std::optional<int> constraint;        // to the part before it that shows ground
  };

  void handle(const SegmentPlaced& e);
  void handle(const EpochBegan& e);
  void handle(const FrameAnchored& e);
  void handle(const KeyframeMarginalised& e);
  void handle(const WindowAdjusted& e);
  void handle(const MapMoved& e);
  template <class Other>
  void handle(const Other&) {}

  Part* part_of(int segment, int keyframe_id);
  bool stands(const FrameAnchored& e) const;
  void forget_height(Part* part);
  std::vector<Seen> seen_in(const Part& part) const;
  void measure_end(Part* part) const;
  std::optional<ScaleEstimate> measure(const std::vector<Seen>& keyframes) const;
  void link_newest();

  const Pinhole pinhole_;
  const Eigen::Vector3d down_;
  const ScaleParams params_;
  const std::shared_ptr<MapLog> log_;
  std::vector<Part> parts_;  // in time order
  Path path_;                // of the newest segment, in its map
  WindowAdjusted window_;
};

}  // namespace edgevo
