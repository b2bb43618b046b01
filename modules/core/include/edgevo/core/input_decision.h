// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the program took an input to be where the input itself does not state it, or not clearly: printed at
// the start of a run, by `edgevo info`, and written to summary.yaml under `input`.
#include <string>
#include <vector>

namespace edgevo {

/// One decision about an input, with its reason.
struct InputDecision {
  /// What was decided, in one or two words, unique in the list: "intensities", "times", "rate",
  /// "orientation", "camera", "order", "mount", "rectified".
  std::string subject;
  /// The decision, as a phrase: "12 bits in 16-bit files", "in microseconds".
  std::string value;
  /// What it rests on, as a phrase: "the largest value of the first 10 images is 4,080"; may be empty.
  std::string reason;
  /// Why it is doubtful, and what to do, as a sentence; empty: not doubtful. A doubt is a warning.
  std::string doubt;
};

/// "SUBJECT: VALUE (REASON)".
inline std::string to_string(const InputDecision& d) {
  return d.subject + ": " + d.value + (d.reason.empty() ? "" : " (" + d.reason + ")");
}

/// The doubts of the decisions as warnings: "Input, SUBJECT: VALUE (REASON): DOUBT".
inline std::vector<std::string> input_warnings(const std::vector<InputDecision>& decisions) {
  std::vector<std::string> warnings;
  for (const InputDecision& d : decisions)
    if (!d.doubt.empty()) warnings.push_back("Input, " + to_string(d) + ": " + d.doubt);
  return warnings;
}

}  // namespace edgevo
