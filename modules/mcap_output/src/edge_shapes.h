// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Points and lines of keyframes as messages hold them: fewer of them, and no more digits than they are worth,
// so that a minute of a run stays below two megabytes.
#include <vector>

#include "edgevo/core/point_filter.h"
#include "edgevo/core/records.h"
#include "edgevo/core/sim3.h"
#include "edgevo/core/timestamp.h"
#include "ros_messages.h"

namespace edgevo {

/// What may be written so far, at a constant rate of time.
class Allowance {
 public:
  /// `per_second`: how much more each second.
  explicit Allowance(double per_second) : per_second_(per_second) {}
  /// The time is now `now`.
  void advance(Timestamp now);
  /// Takes as much of `wanted` as is left; returns it.
  size_t take(size_t wanted);

 private:
  const double per_second_;
  double left_ = 0;
  std::optional<Timestamp> now_;
};

/// How a keyframe is seen: T_map_cam of its camera, with the scale from its lengths to those of the map.
struct ShapeView {
  /// Pinhole that its pixels refer to.
  Pinhole pinhole;
  /// From the camera of the keyframe to `map`.
  Sim3 T_map_cam;
};

/// The points of a keyframe that `filter` keeps; of many, every nth, at most `most`.
std::vector<RosPoint> cloud_of(const KeyframeRecord& keyframe, const ShapeView& view,
                               const PointFilter& filter, size_t most);
/// The number of points that `filter` keeps.
size_t points_kept(const KeyframeRecord& keyframe, const PointFilter& filter);
/// Ends of straight pieces along lines, the longest lines first, at most `most` pieces; a piece departs from
/// its line by no more than the depth is uncertain.
std::vector<Eigen::Vector3d> pieces_of(const std::vector<EdgeLine>& lines, const ShapeView& view,
                                       size_t most);
/// Vertices of lines as a cloud: every nth of each line, and its last; about `most`.
std::vector<RosPoint> samples_of(const std::vector<EdgeLine>& lines, const ShapeView& view, size_t most);

}  // namespace edgevo
