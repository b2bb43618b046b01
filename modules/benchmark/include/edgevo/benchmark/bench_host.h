#pragma once
// What a benchmark asks of the program that runs it.
#include <functional>
#include <optional>
#include <string>

namespace edgevo {

/// Shows how many frames are done; the line ends when the last copy goes.
using ProgressLine = std::function<void(int done)>;

struct BenchHost {
  /// Tells one build of the program from another: a job that another build has run is run again.
  std::string version;
  /// From here on a signal no longer ends the program, but is asked for by `stop`.
  std::function<void()> listen_to_signals;
  /// The user wants the program to end.
  std::function<bool()> stop;
  /// Begins a line of progress: what is done, and how many frames that is, if it is known.
  std::function<ProgressLine(const std::string& what, std::optional<int> total)> progress;
};

}  // namespace edgevo
