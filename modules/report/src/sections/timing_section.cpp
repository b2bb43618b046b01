// SPDX-License-Identifier: BSD-3-Clause
#include "timing_section.h"

#include <algorithm>

#include "edgevo/core/output_file.h"
#include "edgevo/report/chart.h"
#include "edgevo/report/page.h"
#include "edgevo/report/palette.h"
#include "edgevo/run_quality/run_statistics.h"
#include "frame_times.h"

namespace edgevo {
namespace {

std::string stage_table(const Run& run) {
  std::vector<std::vector<std::string>> rows;
  for (auto [name, ms] : stage_times(run)) {
    std::sort(ms.begin(), ms.end());
    double sum = 0;
    for (double v : ms) sum += v;
    rows.push_back({name, std::to_string(ms.size())});
    for (double v : {sum / double(ms.size()), percentile(ms, 0.5), percentile(ms, 0.95), ms.back()})
      rows.back().push_back(fixed(v, 2));
  }
  return table_html({"stage", "frames", "mean ms", "median", "95 %", "max"}, rows);
}

}  // namespace

std::string timing_section(const Run& run) {
  static const char* const kColors[] = {palette::kBlue,   palette::kGreen, palette::kAmber,  palette::kPurple,
                                        palette::kOrange, palette::kTeal,  palette::kViolet, palette::kSlate,
                                        palette::kPink,   palette::kOlive};
  if (stages_of(run).empty()) return section_html("timing", "Time", note_html("No stage ran."));
  TimeChart chart;
  chart.y_name = "CPU ms a frame";
  chart.x = seconds_of(run);
  chart.stacked = true;
  const std::vector<std::string> stages = stages_of(run);
  for (size_t s = 0; s < stages.size(); ++s) {
    Series series{stages[s], kColors[s % std::size(kColors)], {}};
    for (const FrameRecord& f : run.frames) {
      double sum = 0;
      for (const auto& [name, ms] : f.stage_ms)
        if (name == stages[s]) sum += ms;
      series.y.push_back(sum);
    }
    chart.series.push_back(series);
  }
  std::vector<double> totals = total_ms(run);
  std::sort(totals.begin(), totals.end());
  chart.y_max = 1.5 * percentile(totals, 0.98);
  const bool cut = totals.back() > chart.y_max;
  return section_html("timing", "Time by stage",
                      (run.realtime ? note_html("Two threads: " + latency_statement(run) + ".") : "") +
                          draw(chart) +
                          (cut ? note_html("The largest frame takes " + fixed(totals.back(), 0) +
                                           " ms and is cut off in the chart.")
                               : "") +
                          stage_table(run));
}

}  // namespace edgevo
