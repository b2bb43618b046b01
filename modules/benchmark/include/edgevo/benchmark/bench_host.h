// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Services that a benchmark needs from the program that runs it.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/input_decision.h"

namespace edgevo {

/// Shows the number of finished frames; the line ends when the last copy is destroyed.
using ProgressLine = std::function<void(int done)>;

/// Shows what a sequence was taken for.
using ShowInput = std::function<void(const std::string& path, const std::vector<InputDecision>& decisions)>;

/// Version, signals and progress of the program that runs a benchmark.
struct BenchHost {
  /// Identifies the build of the program: jobs of another build are run again.
  std::string version;
  /// From this call on, signals no longer end the program but are reported by `stop`.
  std::function<void()> listen_to_signals;
  /// Whether the user wants the program to end.
  std::function<bool()> stop;
  /// Starts a progress line: its title, and the number of frames if known.
  std::function<ProgressLine(const std::string& what, std::optional<int> total)> progress;
  /// Called for each recorded sequence with open jobs, before they run; may be empty.
  ShowInput show_input = {};
};

}  // namespace edgevo
