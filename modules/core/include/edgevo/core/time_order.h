// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Checks the times of frames as they come. A single bad time (none, a repetition, a step back) costs its
// frame. A clock that was set back for good costs kLasting frames: from then on its times are shifted so that
// they continue those before, because the times of a trajectory must increase and its speeds be right.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/bad_frame.h"
#include "edgevo/core/input_decision.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Stands for the time of a frame that has none.
constexpr Timestamp kNoTime{INT64_MIN};

/// A frame's time as it is to be used.
struct CheckedTime {
  /// Time of the frame; of a frame with a problem that of the last good one, 0 if there is none.
  Timestamp time;
  /// Why the time cannot be used, as a clause; empty: it can.
  std::string problem;
};

/// The times of one sequence, in the order of its frames. A step forward of any length is accepted: nothing
/// distinguishes it from a pause. Cost: none.
class TimeOrder {
 public:
  /// Number of frames in a row that must increase among themselves, all before the last good time, to show
  /// that the clock was set back.
  static constexpr size_t kLasting = 3;

  /// Checks the next frame by its time as stated, in the clock of the source. `following`: the stated time of
  /// the frame after it, where known; it shows a single time in the future from a step of the clock.
  CheckedTime check(Timestamp stated, std::optional<Timestamp> following = std::nullopt);
  /// As check(), but throws BadFrame, prefixed with `where` (the frame), for a time with a problem.
  Timestamp require(int frame_index, Timestamp stated, std::optional<Timestamp> following,
                    const std::string& where);
  /// Amount added to the times that are stated now, seconds; 0 before the clock was set back.
  double shift_s() const { return double(shift_) / double(Timestamp::kTicksPerSecond); }
  /// The same in ticks.
  int64_t shift() const { return shift_; }

 private:
  CheckedTime bad(const std::string& problem);
  bool is_far_beyond(Timestamp time, Timestamp following) const;
  CheckedTime check_late(Timestamp time);
  CheckedTime set_base();

  std::optional<Timestamp> last_;  // good one
  std::vector<Timestamp> late_;    // of the frames since then, shifted as before
  int64_t bad_since_ =
      0;               // bad frames since the last good one, each of which takes a tick (Odometry::skip())
  int64_t shift_ = 0;  // ticks
};

/// `times` with the time before it, or the first one there is, for each that is missing; for statistics.
std::vector<Timestamp> fill_missing(std::vector<Timestamp> times);

/// What checking all times of a source finds: a clock that was set back ("clock"), half the times or more
/// before the time before them ("order"), and pauses of a second and ten median steps at least, in which a
/// camera that moves leaves its map ("pauses").
std::vector<InputDecision> time_decisions(const std::vector<Timestamp>& times);

}  // namespace edgevo
