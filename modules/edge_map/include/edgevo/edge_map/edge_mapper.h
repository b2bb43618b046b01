// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// 3D edge lines of a whole map: made keyframe by keyframe as they leave the window, each 3D edge once.
//
// The edges of a keyframe get their depth from its neighbours on both sides (edge_depth.h). Lines hosted by
// earlier keyframes are projected into it: an edge pixel whose depth they predict, and the views confirm, is
// explained; a vertex that should be visible but is not counts as missed. The remaining pixels become new
// lines, hosted by this keyframe. If this keyframe measures a depth much better than the old host did,
// because it is nearer, its line replaces the old one. A line is final after twelve more keyframes: vertices
// missed more often than seen are removed.
//
// Memory: the images of the few newest keyframes, and the lines. Call it from one thread. With `own_thread`
// the work is done in a thread of its own, which skips keyframes when it is behind.
#include <deque>
#include <memory>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/edge_map/edge_map_params.h"
#include "edgevo/edge_map/edge_trace.h"
#include "edgevo/mapping/keyframe.h"
#include "edgevo/mapping/map_revision.h"

namespace edgevo {

/// Lines hosted by a keyframe, in its frame.
struct HostedLines {
  /// Id of the host keyframe.
  int keyframe_id = -1;
  /// Lines whose vertices are pixels of the host's undistorted image.
  std::vector<EdgeLine> lines;
};

/// Makes the lines of one segment after another.
class EdgeMapper {
 public:
  /// With `own_thread`, add() returns at once. `trace`, unless null, is filled until close().
  EdgeMapper(const Pinhole& pinhole, const EdgeMapParams& params, bool own_thread,
             EdgeTrace* trace = nullptr);
  ~EdgeMapper();

  /// Adds a keyframe that has left the window, in order of id; `younger`: the keyframes after it. The images
  /// are shared.
  void add(const Keyframe& keyframe, const std::deque<Keyframe>& younger);
  /// Moves lines and poses to a corrected camera.
  void apply(const MapRevision& revision);
  /// Ends the segment and returns all its lines, in ascending order of keyframe id.
  std::vector<HostedLines> close();

  /// Number of keyframes skipped because the thread was behind.
  int skipped() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
