// SPDX-License-Identifier: BSD-3-Clause
#include "progress.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace edgevo::app {

Progress::Progress(std::string what, std::optional<int> total)
    : what_(std::move(what)), total_(total), on_terminal_(isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  if (drawn_) std::fputc('\n', stderr);
}

void Progress::say(const std::string& line) {
  if (drawn_) std::fputs("\r\033[K", stderr);
  std::fprintf(stderr, "%s\n", line.c_str());
  drawn_ = false;
  last_ = {};  // the next update draws again
}

void Progress::update(int done) {
  const auto now = Clock::now();
  const bool is_last = total_ && done >= *total_;
  if (!on_terminal_ || (now - last_ < std::chrono::milliseconds(100) && !is_last)) return;
  last_ = now;
  drawn_ = true;
  const double seconds = std::chrono::duration<double>(now - begin_).count();
  const double rate = seconds > 0 ? done / seconds : 0;
  if (total_ && rate > 0)
    std::fprintf(stderr, "\r%s %d/%d  %.1f frames/s  %.0f s left \033[K", what_.c_str(), done, *total_, rate,
                 (*total_ - done) / rate);
  else
    std::fprintf(stderr, "\r%s %d  %.1f frames/s \033[K", what_.c_str(), done, rate);
  std::fflush(stderr);
}

}  // namespace edgevo::app
