// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a program says at the end of a run.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// A line for the user.
struct ClosingLine {
  /// Its text, without a line end.
  std::string text;
  /// Whether it belongs on standard error.
  bool is_warning = false;
};

/// Counts of the run, what is not to be trusted, warnings, latency and the folder of its results.
std::vector<ClosingLine> closing_lines(const Run& run, const std::string& out, bool include_doubtful = false);

/// That most frames of `what` have no pose, or too many poses are doubtful (RunCounts), with the commonest
/// reason; nullopt: neither. `earlier`: folder in which the files of the previous run are kept; empty: none.
std::optional<std::string> failure_statement(const Run& run, const std::string& what,
                                             const std::string& earlier = {});

}  // namespace edgevo
