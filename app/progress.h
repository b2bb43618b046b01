#pragma once
// A progress line with rate and time left, on a terminal only.
#include <chrono>
#include <optional>
#include <string>

namespace edgevo::app {

class Progress {
 public:
  /// `what` opens the line; `total` frames if that is known. Silent when stderr is not a terminal.
  Progress(std::string what, std::optional<int> total);
  /// Ends the line.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `done` frames so far; redraws at most ten times a second.
  void update(int done);
  /// A line of its own, above the progress.
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
