// SPDX-License-Identifier: BSD-3-Clause
#include "resource_use.h"

#include <sys/resource.h>

namespace edgevo {
namespace {

double seconds(const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); }

rusage usage() {
  rusage use{};
  getrusage(RUSAGE_SELF, &use);
  return use;
}

double cpu_seconds(const rusage& use) { return seconds(use.ru_utime) + seconds(use.ru_stime); }

}  // namespace

ResourceMeter::ResourceMeter()
    : wall_begin_(std::chrono::steady_clock::now()), cpu_begin_s_(cpu_seconds(usage())) {}

ResourceUse ResourceMeter::so_far() const {
  const rusage use = usage();
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_begin_;
  return {wall.count(), cpu_seconds(use) - cpu_begin_s_, double(use.ru_maxrss) / 1024};
}

}  // namespace edgevo
