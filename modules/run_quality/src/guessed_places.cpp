// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_quality/guessed_places.h"

#include <algorithm>

#include "edgevo/core/formatted.h"
#include "edgevo/run_quality/carried_unit.h"
#include "edgevo/run_quality/doubtful_intervals.h"

namespace edgevo {
namespace {

bool is_guess(const SegmentRecord& segment) {
  return segment.placed_by == "equal speed" || segment.placed_by == "ratio of depths" ||
         segment.placed_by == "nothing (standstill)";
}

// By views, which give all of a place; the ground gives lengths only.
bool is_linked_across(const Run& run, int first_frame) {
  return std::any_of(run.constraints.begin(), run.constraints.end(), [&](const ConstraintRecord& c) {
    const auto [before, after] = std::minmax(c.from_frame, c.to_frame);
    return c.holds && (c.kind == "features" || c.kind == "place") && before < first_frame &&
           after >= first_frame;
  });
}

// Its keyframes, or frames after them, were found in a map that was kept.
bool is_found_in_kept_map(const Run& run, int first_frame) {
  return std::any_of(run.constraints.begin(), run.constraints.end(), [&](const ConstraintRecord& c) {
    return c.holds && c.kind == "place" && c.from_frame < 0 && c.to_frame >= first_frame;
  });
}

}  // namespace

std::vector<GuessedPlace> guessed_places(const Run& run) {
  std::vector<GuessedPlace> guessed;
  int segment = -1, last = 0;
  bool is_open = false;  // the newest one goes on
  for (const FrameRecord& frame : run.frames) {
    if (!frame.T_world_cam || frame.segment < 0) continue;
    if (frame.segment > segment && size_t(frame.segment) < run.segments.size()) {
      segment = frame.segment;
      const SegmentRecord& placed = run.segments[size_t(segment)];
      if (is_guess(placed) && !is_linked_across(run, frame.index)) {
        if (is_open) guessed.back().last_frame = last;
        guessed.push_back({frame.index, frame.index, placed.placed_by});
        is_open = true;
      }
    }
    last = frame.index;
  }
  if (is_open) guessed.back().last_frame = last;
  return guessed;
}

std::string to_string(const GuessedPlace& guessed) {
  return "frames " + std::to_string(guessed.first_frame) + " to " + std::to_string(guessed.last_frame) +
         ": place and direction are guessed (by " + guessed.by + "): nothing links them to what was before";
}

std::vector<std::string> links_in_words(const Run& run) {
  std::vector<std::string> lines;
  int segment = 0;
  for (const FrameRecord& frame : run.frames) {
    if (!frame.T_world_cam || frame.segment <= segment || size_t(frame.segment) >= run.segments.size())
      continue;
    segment = frame.segment;
    const SegmentRecord& placed = run.segments[size_t(segment)];
    if (!is_guess(placed) && !is_found_in_kept_map(run, frame.index))
      lines.push_back(formatted("frames %d on: unit of length and place by %s, to %.0f %%", frame.index,
                                placed.placed_by.c_str(), 100 * placed.scale_sigma));
  }
  return lines;
}

std::vector<std::string> uncertain_in_words(const Run& run) {
  std::vector<std::string> lines;
  for (const GuessedPlace& guessed : guessed_places(run)) lines.push_back(to_string(guessed));
  for (const PureRotation& turn : pure_rotations(run)) lines.push_back(to_string(turn));
  return lines;
}

std::vector<std::string> not_to_be_trusted(const Run& run) {
  std::vector<std::string> lines;
  for (const DoubtfulInterval& interval : doubtful_intervals(run)) lines.push_back(to_string(interval));
  for (std::string& line : uncertain_in_words(run)) lines.push_back(std::move(line));
  return lines;
}

}  // namespace edgevo
