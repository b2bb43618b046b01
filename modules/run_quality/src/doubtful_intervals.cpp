// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_quality/doubtful_intervals.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "edgevo/core/motion_history.h"
#include "edgevo/core/motion_tolerance.h"

namespace edgevo {
namespace {

// Right frames between two intervals that are one: p_right speaks of the motion over so many.
constexpr int kJoinedFrames = kMotionTolerance.frames;
// Units are compared within so many frames of the doubt, as in MotionHistory. Else it left no frame: those
// that were lost have got poses in the new map.
constexpr int kComparedWithin = int(MotionHistory::kUsualSteps);

// A step on the way to a map is no cause, however long it takes.
bool is_cause(const Reason& reason) {
  constexpr ReasonKind kSteps[] = {ReasonKind::kFirstView,    ReasonKind::kNewFirstView,
                                   ReasonKind::kSearchBehind, ReasonKind::kMapBegun,
                                   ReasonKind::kMapInMaking,  ReasonKind::kMayBeLocated};
  return std::find(std::begin(kSteps), std::end(kSteps), reason.kind) == std::end(kSteps);
}

bool has_cause(const Reasons& reasons) {
  return reasons.empty() || std::any_of(reasons.begin(), reasons.end(), is_cause);
}

// Counts notes by the kinds of their reasons.
class ReasonCounts {
 public:
  void add(const FrameRecord& frame) {
    if (frame.note.empty() || !has_cause(frame.reasons)) return;
    const auto known = std::find_if(counts_.begin(), counts_.end(),
                                    [&](const Count& c) { return are_alike(*c.reasons, frame.reasons); });
    if (known == counts_.end())
      counts_.push_back({&frame.reasons, &frame.note, 1});
    else
      ++known->frames;
  }
  // The first note of the commonest kind; of several the kind that came first.
  std::string commonest() const {
    const auto most = std::max_element(counts_.begin(), counts_.end(),
                                       [](const Count& a, const Count& b) { return a.frames < b.frames; });
    return most == counts_.end() ? "" : *most->first;
  }

 private:
  struct Count {
    const Reasons* reasons;
    const std::string* first;
    int frames;
  };
  std::vector<Count> counts_;
};

bool is_linked_by_view(const RelativeScale& unit) { return unit.is_linked() && !unit.by_ground; }

std::string link_in_words(const RelativeScale& unit) {
  if (!unit.is_linked()) return "nothing links the unit of length after it to that before";
  char text[120];
  std::snprintf(text, sizeof text,
                "the height over the ground links the unit of length after it to that before (times "
                "%.3g +- %.1f %%)",
                unit.ratio, 100 * unit.sigma);
  return text;
}

}  // namespace

std::vector<DoubtfulInterval> doubtful_intervals(const Run& run) {
  std::vector<DoubtfulInterval> intervals;
  ReasonCounts reasons;
  int last = -1;  // position of the last frame of an interval
  const auto close = [&] {
    if (!intervals.empty()) intervals.back().reason = reasons.commonest();
    reasons = {};
  };
  const auto begin_at = [&](const FrameRecord& frame) {
    close();
    intervals.push_back({frame.index, frame.index, 0, "", {}});
  };
  for (size_t i = 0; i < run.frames.size(); ++i) {
    const FrameRecord& frame = run.frames[i];
    if (const auto& unit = frame.evidence.unit) {
      const bool belongs = last >= 0 && int(i) - last <= kComparedWithin;
      if (!belongs && !is_linked_by_view(*unit)) {
        begin_at(frame);
        last = int(i);
      }
      if (belongs || !is_linked_by_view(*unit))
        intervals.back().unit = unit, intervals.back().compared_at = int(i);
    }
    if (!is_doubtful(frame)) continue;
    const bool is_near = last >= 0 && int(i) - last <= kJoinedFrames + 1;
    // Where another unit has begun, what follows is a doubt of that one.
    const bool has_ended =
        !intervals.empty() && intervals.back().unit && !is_linked_by_view(*intervals.back().unit);
    if (!is_near || has_ended) begin_at(frame);
    intervals.back().last_frame = frame.index;
    ++intervals.back().frames;
    reasons.add(frame);
    last = int(i);
  }
  close();
  return intervals;
}

std::vector<DoubtfulInterval> longest(std::vector<DoubtfulInterval> intervals, size_t most) {
  if (intervals.size() <= most) return intervals;
  std::stable_sort(intervals.begin(), intervals.end(),
                   [](const auto& a, const auto& b) { return a.frames > b.frames; });
  intervals.resize(most);
  std::sort(intervals.begin(), intervals.end(),
            [](const auto& a, const auto& b) { return a.first_frame < b.first_frame; });
  return intervals;
}

std::vector<size_t> most_doubtful_frames(const Run& run, size_t most) {
  const auto by_index = [](const FrameRecord& frame, int index) { return frame.index < index; };
  const auto is_worse = [](const FrameRecord& a, const FrameRecord& b) {
    return std::isfinite(a.p_right) && !(a.p_right >= b.p_right);
  };
  std::vector<size_t> worst;
  for (const DoubtfulInterval& interval : longest(doubtful_intervals(run), most)) {
    const auto begin = std::lower_bound(run.frames.begin(), run.frames.end(), interval.first_frame, by_index);
    const auto end = std::lower_bound(begin, run.frames.end(), interval.last_frame + 1, by_index);
    auto lowest = begin;
    for (auto frame = begin; frame != end; ++frame)
      if (is_worse(*frame, *lowest)) lowest = frame;
    worst.push_back(size_t(lowest - run.frames.begin()));
  }
  return worst;
}

std::string why(const DoubtfulInterval& interval) {
  if (!interval.unit || is_linked_by_view(*interval.unit)) return interval.reason;
  return interval.reason + (interval.reason.empty() ? "" : "; ") + link_in_words(*interval.unit);
}

std::string to_string(const DoubtfulInterval& interval) {
  const std::string frames =
      interval.first_frame == interval.last_frame
          ? "frame " + std::to_string(interval.first_frame)
          : "frames " + std::to_string(interval.first_frame) + " to " + std::to_string(interval.last_frame);
  const std::string reason = why(interval);
  return reason.empty() ? frames : frames + ": " + reason;
}

std::string commonest_doubt(const Run& run) {
  ReasonCounts reasons;
  for (const FrameRecord& frame : run.frames)
    if (is_doubtful(frame) || !frame.T_world_cam) reasons.add(frame);
  return reasons.commonest();
}

FramesWithoutPose frames_without_pose(const Run& run) {
  FramesWithoutPose lacking;
  ReasonCounts reasons;
  for (const FrameRecord& frame : run.frames)
    if (!frame.T_world_cam && !is_doubtful(frame)) ++lacking.frames, reasons.add(frame);
  lacking.reason = reasons.commonest();
  return lacking;
}

}  // namespace edgevo
