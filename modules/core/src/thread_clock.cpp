// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/thread_clock.h"

#include <time.h>

namespace edgevo {

double thread_cpu_ms() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * double(t.tv_sec) + 1e-6 * double(t.tv_nsec);
}

}  // namespace edgevo
