#include "print_run.h"

#include <algorithm>
#include <cstdio>

#include "edgevo/report/latency_figures.h"
#include "edgevo/report/warnings.h"

namespace edgevo::app {

void print_run(const Run& run, const std::string& out) {
  size_t posed = 0, lost = 0, points = 0, lines = 0;
  int segments = 0;
  for (const FrameRecord& f : run.frames) {
    posed += f.T_world_cam.has_value();
    lost += f.state == TrackingState::kLost;
    segments = std::max(segments, f.segment + 1);
  }
  for (const KeyframeRecord& k : run.keyframes) points += k.points.size(), lines += k.lines.size();
  std::printf(
      "%zu frames, %zu with a pose, %zu lost, %d segment(s), %zu keyframes, %zu edge points, %zu lines; "
      "scale %s\n",
      run.frames.size(), posed, lost, segments, run.keyframes.size(), points, lines,
      run.scale_source.c_str());
  if (run.realtime) std::printf("%s\n", latency_statement(run).c_str());
  for (const std::string& warning : run_warnings(run)) std::fprintf(stderr, "WARNING: %s\n", warning.c_str());
  std::printf("results in %s (summary.yaml tells what is there)\n", out.c_str());
}

}  // namespace edgevo::app
