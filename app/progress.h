// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Progress line with rate and remaining time, on a terminal only.
#include <chrono>
#include <optional>
#include <string>

namespace edgevo::app {

class Progress {
 public:
  /// The line starts with `what`; `total` is the number of frames, if known. Silent when stderr is not a
  /// terminal.
  Progress(std::string what, std::optional<int> total);
  /// Ends the progress line with a newline.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows `done` frames; redraws at most ten times a second.
  void update(int done);
  /// Prints a line above the progress line.
  void say(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;

  std::string what_;
  std::optional<int> total_;
  bool on_terminal_;
  bool drawn_ = false;
  Clock::time_point begin_ = Clock::now(), last_ = begin_;
};

}  // namespace edgevo::app
