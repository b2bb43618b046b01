// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The owner of all keyframes and segments of a run.
//
// A keyframe is active while the window adjusts it, then marginalised. What later steps need of a
// marginalised keyframe is kept as long as they need it: its images (edge lines, later places), and its
// matches (self-calibration); its record is kept for good and is shared with the consumers of the events.
// Every change but the adjustment itself is an event (map_event.h).
//
// One thread at a time: that of mapping. Other threads follow the map through the MapLog.
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <vector>

#include "edgevo/core/rectification.h"
#include "edgevo/map/keyframe.h"
#include "edgevo/map/map_event.h"
#include "edgevo/map/map_log.h"

namespace edgevo {

/// Keyframes and segments of a run.
class Map {
 public:
  /// `rectification`: from the images as they were taken to those that are worked on; `log`, not null,
  /// receives the events.
  Map(const Rectification& rectification, std::shared_ptr<MapLog> log);

  /// The keyframes of the window, oldest first; empty without a map.
  std::deque<Keyframe>& active() { return active_; }
  /// The keyframes of the window, oldest first.
  const std::deque<Keyframe>& active() const { return active_; }
  /// The marginalised keyframes of the present segment that still have their matches, oldest first, without
  /// immature points and corners. Those whose images were evicted have no pyramid.
  const std::deque<Keyframe>& marginalised() const { return marginalised_; }
  /// Number of the present segment; -1: none.
  int segment() const { return segment_; }

  /// Appends the newest keyframe; ids ascend over the run. Before begin_segment() it is not announced.
  void add(Keyframe keyframe);
  /// Drops the active keyframes of a map that was refused before begin_segment().
  void discard();
  /// Announces the active keyframes as the beginning of a segment.
  void begin_segment(int segment);
  /// Moves the oldest active keyframe to the marginalised ones and returns it.
  const Keyframe& marginalise_oldest(std::vector<NeighbourPose> neighbours);
  /// Announces the state of the active keyframes, after an adjustment. Cost: a copy of their points, about
  /// 0.1 ms.
  void announce_window();
  /// Ends the segment, which must have no active keyframes: forgets images and matches.
  void end_segment();

  /// Rebuilds the pyramid of a keyframe for a new correction of the camera.
  using Rebuild = std::function<std::shared_ptr<const FramePyramid>(const Keyframe&)>;
  /// Moves keyframes and announces it. All measurements in the images of active keyframes follow a change of
  /// the lens, and their images are rebuilt; images of marginalised ones are evicted then. Returns the move
  /// as announced.
  ///
  /// Throws std::invalid_argument, and changes nothing, if the segment is not the present one; if the ids do
  /// not ascend or one is not known; if points are missing or do not match those of the keyframe; if an
  /// active keyframe would move and the move has no prior; if the newest keyframe would leave its place; or
  /// if the lens changes and an active keyframe has no move.
  MapMoved move(MapMoved moved, const Rebuild& rebuild);

  /// Drops the images of all marginalised keyframes but the newest `keep`.
  void evict_images(size_t keep);
  /// Drops all marginalised keyframes from marginalised() but the newest `keep`; their records stay.
  void evict_matches(size_t keep);

  /// Drops the records of all keyframes before those of marginalised(): they are in the events, and cannot be
  /// moved any more.
  void evict_records();

  /// A marginalised keyframe of any segment.
  struct Stored {
    /// Number of its segment.
    int segment = 0;
    /// The keyframe in the segment's map, without lines.
    std::shared_ptr<const KeyframeRecord> keyframe;
  };
  /// All marginalised keyframes of the run, by id.
  const std::map<int, Stored>& stored() const { return stored_; }
  /// Number of moves so far in this run.
  int moves() const { return moves_; }

 private:
  void check(const MapMoved& moved) const;
  const Keyframe* find(int keyframe_id) const;
  void move_stored(const MapMoved& moved);

  Rectification rectification_;
  std::shared_ptr<MapLog> log_;
  int segment_ = -1;
  int moves_ = 0;
  std::deque<Keyframe> active_, marginalised_;
  std::map<int, Stored> stored_;
};

/// The record of a keyframe in its map; without images the gray values are 0.
KeyframeRecord make_record(const Keyframe& keyframe, int segment);

}  // namespace edgevo
