// SPDX-License-Identifier: BSD-3-Clause
#include "standard_output.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace edgevo::app {

void print_line_by_line() { std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ); }

int end_of_output(int code) {
  constexpr int kBadOutput = 2;
  errno = 0;
  const bool failed_before = std::ferror(stdout) != 0;
  if (std::fflush(stdout) == 0 && !failed_before) return code;
  const char* const why = errno != 0 ? std::strerror(errno) : "a part could not be written";
  std::fprintf(stderr, "edgevo: standard output: cannot be written (%s); free space or print elsewhere\n",
               why);
  return code == 0 ? kBadOutput : code;
}

}  // namespace edgevo::app
