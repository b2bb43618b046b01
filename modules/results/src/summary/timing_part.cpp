// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "edgevo/run_quality/run_statistics.h"
#include "summary_parts.h"

namespace edgevo {
namespace {

void write_stage(const std::string& stage, std::vector<double> ms, YamlWriter* y) {
  std::sort(ms.begin(), ms.end());
  double sum = 0;
  for (double v : ms) sum += v;
  y->open(stage);
  y->integer("frames", long(ms.size()));
  y->number("mean", sum / double(ms.size()), 3);
  y->number("median", percentile(ms, 0.5), 3);
  y->number("p95", percentile(ms, 0.95), 3);
  y->number("max", ms.back(), 3);
  y->close();
}

void write_stages(const Run& run, YamlWriter* y) {
  const auto stages = stage_times(run);
  if (stages.empty()) return;  // MRPT's YAML reader refuses a key without a value
  y->open("stages_ms");
  for (const auto& [name, ms] : stages) write_stage(name, ms, y);
  y->close();
}

}  // namespace

void write_realtime(const Run& run, YamlWriter* y) {
  if (!run.realtime) return;
  const RealtimeRecord& r = *run.realtime;
  y->open("realtime");
  y->text("pace", r.pace);
  y->number("frames_per_second", r.frames_per_second, 3);
  y->integer("handed_over", r.delivered);
  y->integer("late", r.late);
  y->integer("dropped", r.dropped);
  y->integer("left_out_of_mapping", r.skipped_by_mapping);
  y->integer("shed_lines", r.shed.lines);
  y->integer("shed_depths", r.shed.depths);
  y->integer("shed_points", r.shed.points);
  if (const auto latency = latency_figures(run)) {
    y->open("latency_ms");
    for (const auto& [name, ms] : {std::pair("p50", latency->p50),
                                   {"p95", latency->p95},
                                   {"p99", latency->p99},
                                   {"max", latency->max}})
      y->number(name, ms, 3);
    y->close();
  }
  y->close();
}

void write_timing(const SummaryInput& input, YamlWriter* y) {
  const double frames = std::max<double>(1, double(input.run.frames.size()));
  y->open("timing");
  y->number("wall_s", input.use.wall_s, 3);
  y->number("wall_ms_per_frame", 1000 * input.use.wall_s / frames, 3);
  y->number("cpu_ms_per_frame", 1000 * input.use.cpu_s / frames, 3);
  y->number("outputs_wall_s", input.use_with_outputs.wall_s - input.use.wall_s, 3);
  write_stages(input.run, y);
  y->close();
  y->open("memory");
  y->number("peak_mb", input.use_with_outputs.peak_memory_mb, 1);
  y->close();
}

}  // namespace edgevo
