// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// 3D edge lines of a whole map: made keyframe by keyframe as they leave the window, each 3D edge once.
//
// The edges of a keyframe get their depth from its neighbours on both sides (edge_depth.h). Lines hosted by
// earlier keyframes are projected into it: an edge pixel whose depth they predict, and the views confirm, is
// explained; a vertex that should be visible but is not counts as missed. The remaining pixels become new
// lines, hosted by this keyframe. If this keyframe measures a depth much better than the old host did,
// because it is nearer, its line replaces the old one. A line is final after twelve more keyframes: vertices
// that keyframes see less than chance would are removed.
//
// Keeps no keyframes: it reads those of the map, and its final lines are events (LinesFinished). Memory: the
// lines that are not final. Call it from one thread. With `own_thread` the work is done in a thread of its
// own, which skips keyframes when it is behind.
#include <memory>

#include "edgevo/edge_map/edge_map_params.h"
#include "edgevo/edge_map/edge_trace.h"
#include "edgevo/edge_map/view_alignment.h"
#include "edgevo/map/map.h"

namespace edgevo {

/// Makes the lines of one segment after another.
class EdgeMapper {
 public:
  /// `log`, not null, receives the lines of each keyframe once they are final, in ascending order of id. With
  /// `own_thread`, add() returns at once. `how`: frames between keyframes are aligned. `trace`, unless null,
  /// is filled until close().
  EdgeMapper(const Rectification& rectification, const EdgeMapParams& params, const ViewAlignment& how,
             bool own_thread, std::shared_ptr<MapLog> log, EdgeTrace* trace = nullptr);
  ~EdgeMapper();

  /// Adds the keyframe that was marginalised last, unless it is doubtful: such a keyframe neither gets lines
  /// nor is a view of others. Its edges are looked for in the images of the active keyframes and of those
  /// marginalised before it.
  void add(const Map& map);
  /// Adds a frame between keyframes as another view: what is near leaves the view before a second keyframe
  /// sees it. Where the camera is fast, it gets lines, too, as lines of that keyframe. `T_view_keyframe`: its
  /// motion from keyframe `keyframe_id`, an active one. Of the frames of one keyframe the first four are
  /// kept, their edges alone. Cost: 1 ms, 0.7 MB at 1241x376.
  void add_view(int keyframe_id, const SE3& T_view_keyframe, const FramePyramid& pyramid);
  /// Number of newest marginalised keyframes whose images and matches the next add() uses.
  size_t keyframes_needed() const;
  /// Waits until all keyframes added so far are processed: their events then precede what the caller appends.
  void wait_idle();
  /// Whether wait_idle() would not wait.
  bool is_idle() const;
  /// Moves what is not final; call wait_idle() before the move is announced.
  void apply(const MapMoved& moved);
  /// Ends the segment: all lines become final.
  void close();

  /// Number of keyframes skipped because the thread was behind.
  int skipped() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
