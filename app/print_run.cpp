// SPDX-License-Identifier: BSD-3-Clause
#include "print_run.h"

#include <cstdio>

#include "edgevo/core/run_statistics.h"
#include "edgevo/core/run_warnings.h"

namespace edgevo::app {

void print_run(const Run& run, const std::string& out) {
  const RunCounts n = count(run);
  std::printf(
      "%d frames, %d with a pose, %d lost, %d segment(s), %d keyframes, %zu edge points, %zu lines; scale "
      "%s\n",
      n.frames, n.with_pose, n.lost, n.segments, n.keyframes, n.points, n.lines, run.scale_source.c_str());
  if (run.realtime) std::printf("%s\n", latency_statement(run).c_str());
  for (const std::string& warning : run_warnings(run)) std::fprintf(stderr, "WARNING: %s\n", warning.c_str());
  std::printf("results in %s (listed in summary.yaml)\n", out.c_str());
}

}  // namespace edgevo::app
