// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Where a part of the path stands is a guess if nothing seen before it is seen again: after a loss the camera
// is taken to go on as before. Each part may be right, and no frame of it doubtful.
#include <string>
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// Frames of a run whose place and direction against all before are a guess.
struct GuessedPlace {
  /// Indices in the source of the first and the last frame.
  int first_frame = 0, last_frame = 0;
  /// What the guess rests on: SegmentRecord::placed_by.
  std::string by;
};

/// The parts of the run whose place is a guess, in time order: each goes on to the next one, or to the end of
/// the run. A segment is placed if both maps show a view, or once a link that holds leads from before it to a
/// frame of it or after. Cost: linear.
std::vector<GuessedPlace> guessed_places(const Run& run);

/// "frames 100 to 199: place and direction are guessed (by equal speed): nothing links them to what was
/// before".
std::string to_string(const GuessedPlace& guessed);

/// What segments rest on whose place is not guessed, by views of both maps: "frames 81 on: unit of length and
/// place by views of both maps, to 3 %"; the error of a place grows with the way that was not seen.
std::vector<std::string> links_in_words(const Run& run);

/// The guessed places and the pure rotations (carried_unit.h) in words: what no doubtful frame shows.
std::vector<std::string> uncertain_in_words(const Run& run);

/// The doubtful intervals and the above in words: what is not to be trusted.
std::vector<std::string> not_to_be_trusted(const Run& run);

}  // namespace edgevo
