// SPDX-License-Identifier: BSD-3-Clause
#include "print_run.h"

#include <cstdio>

#include "edgevo/run_quality/doubtful_intervals.h"
#include "edgevo/run_quality/run_statistics.h"
#include "edgevo/run_quality/run_warnings.h"

namespace edgevo::app {

namespace {

// The longest intervals, in time order: what a console has room for.
void print_doubtful(const Run& run) {
  constexpr size_t kShown = 5;
  const std::vector<DoubtfulInterval> all = doubtful_intervals(run);
  const std::vector<DoubtfulInterval> shown = longest(all, kShown);
  for (const DoubtfulInterval& interval : shown)
    std::fprintf(stderr, "NOT TO BE TRUSTED: %s\n", to_string(interval).c_str());
  if (shown.size() < all.size())
    std::fprintf(stderr, "and %zu shorter intervals, listed in summary.yaml\n", all.size() - shown.size());
}

}  // namespace

void print_run(const Run& run, const std::string& out, bool include_doubtful) {
  const RunCounts n = count(run);
  std::printf(
      "%d frames, %d with a pose, %d doubtful, %d segment(s), %d keyframes, %zu edge points, %zu lines; "
      "scale "
      "%s\n",
      n.frames, n.with_pose, n.doubtful, n.segments, n.keyframes, n.points, n.lines,
      run.scale_source.c_str());
  print_doubtful(run);
  if (n.doubtful_keyframes > 0 && !include_doubtful)
    std::printf("%d keyframes were made in doubt: the maps are without their points (--include-doubtful)\n",
                n.doubtful_keyframes);
  if (run.realtime) std::printf("%s\n", latency_statement(run).c_str());
  for (const std::string& warning : run_warnings(run)) std::fprintf(stderr, "WARNING: %s\n", warning.c_str());
  std::printf("results in %s (listed in summary.yaml)\n", out.c_str());
}

int print_failure(const Run& run, const std::string& what, const std::string& earlier) {
  constexpr int kDone = 0, kMostlyFailed = 3;
  const RunCounts n = count(run);
  if (!n.mostly_failed() && !n.is_largely_doubtful()) return kDone;
  const std::string reason = commonest_doubt(run);
  const std::string problem = n.mostly_failed()
                                  ? "tracking failed for most of " + what
                                  : std::to_string(n.doubtful_poses()) + " of " +
                                        std::to_string(n.with_pose) + " poses of " + what + " are doubtful";
  std::fprintf(stderr, "edgevo: %s; mostly: %s%s\n", problem.c_str(),
               reason.empty() ? "no reason was noted" : reason.c_str(),
               earlier.empty() ? "" : ("; the earlier run is kept in " + earlier).c_str());
  return kMostlyFailed;
}

}  // namespace edgevo::app
