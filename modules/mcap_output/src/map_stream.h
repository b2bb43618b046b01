// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Points and lines of keyframes as they are done, in the frame `map`.
#include <map>

#include "edge_shapes.h"
#include "edgevo/core/camera.h"
#include "edgevo/map/map_event.h"
#include "live_frames.h"
#include "topics.h"

namespace edgevo {

/// Writes what keyframes show. For one thread.
class MapStream {
 public:
  /// `file` and `frames` must outlive this object.
  MapStream(TopicFile* file, const LiveFrames* frames, const Pinhole& pinhole, const PointFilter& filter);

  /// The newest frame is of this time: so are the messages.
  void set_now(Timestamp now);
  /// A keyframe has left the window: its points, unless it is doubtful.
  void add(const KeyframeMarginalised& marginalised);
  /// Keyframes have moved: those whose lines are still to come.
  void apply(const MapMoved& moved);
  /// The lines of a keyframe are done.
  void add(const LinesFinished& lines);

 private:
  struct Host {
    int segment = 0;
    SE3 T_segment_cam;
  };
  ShapeView view_of(int keyframe_id, const Host& host) const;

  TopicFile& file_;
  const LiveFrames& frames_;
  const Pinhole pinhole_;
  const PointFilter filter_;
  Timestamp now_;
  Allowance points_, pieces_, samples_;
  std::map<int, Host> hosts_;  // by id, those without lines so far
};

}  // namespace edgevo
