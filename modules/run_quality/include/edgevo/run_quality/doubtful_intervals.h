// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The parts of a run that are not to be trusted, and why: for the closing lines of `edgevo run`, its exit
// code, summary.yaml and the report.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/doubtful_frame.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// Frames in a row that are not to be trusted.
struct DoubtfulInterval {
  /// Indices in the source of the first and the last frame.
  int first_frame = 0, last_frame = 0;
  /// Number of doubtful frames among them.
  int frames = 0;
  /// The commonest note among these frames: what spoke against the poses. Notes of the same kinds of reasons
  /// count as one; the first of them is given.
  std::string reason;
  /// The last comparison of the units of length before and after the interval; nothing if there was none.
  std::optional<RelativeScale> unit;
  /// Position in Run::frames of the frame of that comparison; -1: none.
  int compared_at = -1;
  /// Whether the unit after the interval may be another one than before: nothing links them.
  bool is_scale_unresolved() const { return unit && !unit->is_linked(); }
};

/// The doubtful intervals of the run, in time order. Intervals that are at most ten frames apart are one: it
/// takes that long to see whether a motion is right. A frame at which nothing links the unit of length to
/// that before is one by itself if none precedes it: what was lost has got poses in a new map. Cost: linear.
std::vector<DoubtfulInterval> doubtful_intervals(const Run& run);

/// The `most` intervals with the most doubtful frames, in time order.
std::vector<DoubtfulInterval> longest(std::vector<DoubtfulInterval> intervals, size_t most);

/// Positions in Run::frames of the frame with the lowest p_right of each of the longest `most` intervals, in
/// time order; of an interval without any p_right its first frame.
std::vector<size_t> most_doubtful_frames(const Run& run, size_t most);

/// The reason, and that nothing or the ground links the unit of length, if so; empty: unknown.
std::string why(const DoubtfulInterval& interval);

/// The interval in words: "frames 42 to 124: scale of the corners fell by 0.4 in 12 frames".
std::string to_string(const DoubtfulInterval& interval);

/// The commonest reason of all frames that are doubtful or have no pose, as DoubtfulInterval::reason; empty
/// if there is none.
std::string commonest_doubt(const Run& run);

/// Frames without a pose that are in no interval of doubtful ones, as before the first map.
struct FramesWithoutPose {
  /// Number of them.
  int frames = 0;
  /// The commonest kind of note among them, as in commonest_doubt(); empty if there is none.
  std::string reason;
};
/// Those of the run. Cost: linear.
FramesWithoutPose frames_without_pose(const Run& run);

}  // namespace edgevo
