// SPDX-License-Identifier: BSD-3-Clause
// LD_PRELOADed into a program: the wall clock goes back by 30 s once the file named by EDGEVO_TEST_SET_BACK
// exists, as when NTP sets it.
#include <dlfcn.h>
#include <time.h>
#include <unistd.h>

#include <cstdlib>

extern "C" int clock_gettime(clockid_t clock, timespec* t) {
  using Function = int (*)(clockid_t, timespec*);
  static const auto real = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "clock_gettime"));
  const int result = real(clock, t);
  static const char* const path = std::getenv("EDGEVO_TEST_SET_BACK");
  if (clock == CLOCK_REALTIME && path && access(path, F_OK) == 0) t->tv_sec -= 30;
  return result;
}
