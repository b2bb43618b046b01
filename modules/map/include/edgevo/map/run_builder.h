// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The result of a run from its events: each frame is anchored to a keyframe and moves with it, whatever moves
// the keyframe later. `edgevo run` builds its results from the events as they happen, `edgevo finish` from
// those on disk, with this same code.
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/core/rectification.h"
#include "edgevo/map/epochs.h"
#include "edgevo/map/map_event.h"
#include "edgevo/map/run_path.h"

namespace edgevo {

/// Applies a move to the record of a keyframe that is in its segment's map: pose, points and lines.
void apply_move(const Rectification& rectification, const MapMoved& moved, const KeyframeMove& move,
                KeyframeRecord* keyframe);
/// Applies a move to a vertex of a line that the keyframe hosts.
void apply_move(const Rectification& rectification, const MapMoved& moved, const KeyframeMove& move,
                EdgeVertex* vertex);
/// From a segment's map to the world: lengths grow by the scale, inverse depths shrink.
void move_to_world(const Sim3& T_world_map, KeyframeRecord* keyframe);

/// The live pose of a frame.
struct TimedPose {
  /// Timestamp of the frame.
  Timestamp time;
  /// Its pose when it was processed.
  SE3 T_world_cam;
};

/// Collects frames, keyframes and segments of a run. For one thread.
class RunBuilder {
 public:
  /// `rectification`: from the images as they were taken to those that the method works on.
  explicit RunBuilder(const Rectification& rectification);

  /// Keeps only the newest `frames` rows from now on, and no keyframes: those who need more read the events
  /// as they come. finish() then returns these rows with their live poses.
  void forget_all_but(size_t frames) { most_rows_ = frames; }
  /// Keeps the place of a keyframe nevertheless: a constraint may name it later.
  void keep(int keyframe_id) { kept_.insert(keyframe_id); }

  /// Applies the next event. An event about a keyframe or segment that is not known is ignored: it can only
  /// come from a log on disk that was cut off.
  void apply(const MapEvent& event);

  /// The newest record of a frame; null if there is none.
  const FrameRecord* find(int frame_index) const;
  /// A keyframe that is marginalised or in the window, by its id; nothing if it is not known (any more).
  std::optional<KeyframeInMap> find_keyframe(int id) const { return path_.find(id); }
  /// Live poses of a segment up to `last_frame`: the last `at_most` of them, oldest first.
  std::vector<TimedPose> last_poses(int segment, int last_frame, size_t at_most) const;
  /// The last `count` live poses in a row of a segment, up to `last_frame`, none of them doubtful
  /// (core/doubtful_frame.h), oldest first; empty if there is no such row.
  std::vector<TimedPose> last_trusted_poses(int segment, int last_frame, size_t count) const;
  /// Pose in the segment's map of the last frame before `frame_index` that has one; nothing if that frame is
  /// of another segment.
  std::optional<SE3> pose_before(int frame_index, int segment) const;
  /// From the map of a segment that has begun to the frame of live poses, in which nothing jumps: the unit of
  /// what is measured from now on is that of its newest epoch, as far as it is known.
  const Sim3& T_odom_map(int segment) const { return T_odom_map_[size_t(segment)]; }
  /// Where the epochs lie by what is known so far.
  PlacedEpochs place_epochs() const { return path_.epochs.solve(run_so_far()); }
  /// Where all keyframes lie (Epochs::solve_keyframes()).
  PlacedEpochs place_keyframes() const;
  /// The same for another thread: what is known now, to be solved by a call. Cost: a copy of the path, 0.2 ms
  /// at 1,000 keyframes.
  std::function<PlacedEpochs()> keyframes_to_place() const;
  /// Number of epochs so far.
  size_t epochs() const { return path_.epochs.count(); }
  /// Number of the marginalised keyframes that are known.
  size_t keyframes() const { return path_.marginalised.size(); }
  /// What is to be announced of it: live poses to come have the unit that was found for the map of `segment`,
  /// and the camera at `newest_position` in that map stays where it is.
  EpochsPlaced follow_epochs(PlacedEpochs placed, int segment, const Eigen::Vector3d& newest_position) const;
  /// Fills what an epoch says of the frames after `frame` up to `later_frame`, which it begins with.
  void describe_doubt(int frame, int later_frame, EpochBegan* began) const;
  /// Number of frames so far, forgotten ones included.
  size_t frames() const { return forgotten_ + rows_.size(); }

  /// Takes the keyframes of the newest WindowAdjusted as marginalised, except those that have been, and those
  /// of frames that are not known: the end of a run that was killed. Does nothing if the map has moved since.
  /// Returns their number.
  size_t adopt_window();
  /// Returns final poses and keyframes in the world. A frame whose keyframe is not known (one that a killed
  /// run had not brought to the disk) has its pose as it was tracked in the map. Call once.
  Run finish();

 private:
  struct Row {
    FrameRecord frame;
    std::optional<FrameAnchor> anchor;
    FrameMapped mapping;
  };
  struct Entry {
    // Without lines; shared with other consumers until the keyframe moves.
    std::shared_ptr<const KeyframeRecord> keyframe;
    std::vector<EdgeLine> lines;
  };

  void handle(const SegmentPlaced& e);
  void handle(const EpochBegan& e) { path_.epochs.begin_epoch(e); }
  void handle(const ConstraintAdded& e) { path_.epochs.add(e); }
  void handle(const ConstraintWithdrawn& e) { path_.epochs.withdraw(e.id); }
  void handle(const EpochsPlaced& e);
  void handle(const KeyframeAdded&) {}
  void handle(const KeyframeMarginalised& e);
  void handle(const MapMoved& e);
  void handle(const WindowAdjusted& e) { path_.window = e; }
  void handle(const LinesFinished& e);
  void handle(const CameraEstimated& e) { camera_ = e.camera; }
  void handle(const FrameMapped& e);
  void handle(const FrameAnchored& e);

  bool forgets() const { return most_rows_ > 0; }
  Row& row(size_t number) { return rows_[number - forgotten_]; }
  const Row& row(size_t number) const { return rows_[number - forgotten_]; }
  bool is_known(int segment) const { return segment >= 0 && size_t(segment) < T_odom_map_.size(); }
  RunSoFar run_so_far() const;
  double doubt_between(int frame, int later_frame) const;
  void forget_places_before(int frame_index);
  void add_keyframe(int id, std::shared_ptr<const KeyframeRecord> keyframe);
  // What a move of the map has changed near a keyframe.
  struct Change {
    int move = 0;            // its number
    double scale_ratio = 1;  // new over old length
    double image_ratio = 1;  // new over old distance from the centre of the image, of any point
  };
  Change changes_since(int keyframe_id, int moves) const;
  void anchor_to_own_keyframe(int keyframe_id, const KeyframeRecord& keyframe);
  std::vector<EpochRecord> epoch_records(const PlacedEpochs& placed) const;
  std::vector<ConstraintRecord> constraint_records(const PlacedEpochs& placed) const;
  void finish_row(const PlacedEpochs& placed, const std::map<int, int>& position_of_keyframe,
                  const std::vector<KeyframeRecord>& keyframes, Row* row) const;

  Rectification rectification_;
  CameraPosterior camera_;
  size_t most_rows_ = 0;  // 0: all
  std::set<int> kept_;    // keep()
  size_t forgotten_ = 0;  // rows before those of rows_
  std::deque<Row> rows_;
  std::map<int, size_t> position_;              // frame index -> number of the row
  std::map<int, Entry> keyframes_;              // the marginalised ones, by id
  std::map<int, std::vector<Change>> changes_;  // by keyframe id, also of keyframes of the window
  RunPath path_;                                // with forgets() the newest keyframes, and those of keep()
  std::vector<Sim3> T_odom_map_;                // by segment, as the next
  std::vector<SegmentRecord> segments_;
  int moves_ = 0;
};

}  // namespace edgevo
