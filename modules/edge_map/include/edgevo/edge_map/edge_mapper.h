#pragma once
// The lines of edges of a whole map: keyframe after keyframe as they leave the window, each 3D edge once.
//
// A keyframe's edges get their depth from its neighbours on both sides (edge_depth.h). Lines that earlier
// keyframes host are first projected into it: an edge pixel whose depth they tell, and the views confirm, is
// explained and needs no search; a vertex that should be seen and is not is missed. What is left becomes new
// lines, hosted here. Where this keyframe tells a depth much better than the old host did, because it is
// nearer, its line takes the old one's place. A line is settled when twelve more have passed:
// vertices missed more often than seen go.
//
// Memory: the images of the few newest keyframes, and the lines. One thread; with a thread of its own the
// work is done there, and what it cannot keep up with is left out.
#include <deque>
#include <memory>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/edge_map/edge_map_params.h"
#include "edgevo/edge_map/edge_trace.h"
#include "edgevo/mapping/keyframe.h"
#include "edgevo/mapping/map_revision.h"

namespace edgevo {

/// The lines of a keyframe, in its frame.
struct HostedLines {
  int keyframe_id = -1;         ///< that hosts them
  std::vector<EdgeLine> lines;  ///< vertices in its undistorted image
};

/// Makes the lines of one segment after another.
class EdgeMapper {
 public:
  /// `own_thread`: add() returns at once. `trace`: filled until close() if not null.
  EdgeMapper(const Pinhole& pinhole, const EdgeMapParams& params, bool own_thread,
             EdgeTrace* trace = nullptr);
  ~EdgeMapper();

  /// A keyframe that has left the window, in order of id; `younger`: those after it. The images are shared.
  void add(const Keyframe& keyframe, const std::deque<Keyframe>& younger);
  /// The camera was corrected: lines and poses move along.
  void apply(const MapRevision& revision);
  /// Ends the segment: all its lines, ascending id.
  std::vector<HostedLines> close();

  /// Keyframes whose lines were left out, since the thread was behind.
  int left_out() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
