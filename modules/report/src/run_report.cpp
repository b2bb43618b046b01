// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/report/run_report.h"

#include <algorithm>

#include "advice.h"
#include "edgevo/core/output_file.h"
#include "edgevo/report/chart.h"
#include "edgevo/report/page.h"
#include "edgevo/run_quality/run_statistics.h"
#include "sections/edges_section.h"
#include "sections/epochs_section.h"
#include "sections/map_section.h"
#include "sections/map_view_section.h"
#include "sections/mask_section.h"
#include "sections/scale_section.h"
#include "sections/timing_section.h"
#include "sections/tracking_section.h"
#include "sections/trajectory_section.h"
#include "sections/trust_section.h"

namespace edgevo {
namespace {

std::string advice_section(const ReportInput& in) {
  std::string body = "<ul>\n";
  for (const std::string& file : in.not_written)
    body +=
        "<li class=\"bad\">" + html_escaped(file) + " could not be written: free space and run again.</li>\n";
  for (const Advice& a : advise(in.run, in.info))
    body += "<li>" + html_escaped(a.text) +
            (a.command.empty() ? "" : " <code>" + html_escaped(a.command) + "</code>") + "</li>\n";
  return section_html("next", "What to do next", body + "</ul>\n");
}

std::string tiles(const Run& run, const std::optional<TruthComparison>& truth) {
  const ShownPath path = path_of(run, truth);
  const auto posed =
      std::count_if(path.estimate.begin(), path.estimate.end(), [](const auto& p) { return p.has_value(); });
  const RunCounts counts = count(run);
  double ms = 0;
  for (double t : total_ms(run)) ms += t;
  const double frames = std::max<double>(1, double(run.frames.size()));
  std::vector<std::pair<std::string, std::string>> tiles{
      {std::to_string(run.frames.size()), "frames"},
      {fixed(100 * double(posed) / frames, 1) + " %", "have a pose"},
      {std::to_string(counts.segments), counts.segments == 1 ? "segment" : "segments"},
      {fixed(path_length(path, run), 2) + ' ' + path.unit, "path length"},
      {std::to_string(run.keyframes.size()), "keyframes"},
      {std::to_string(counts.points), "edge points"},
      {fixed(ms / frames, 1) + " ms", "CPU a frame"}};
  if (truth)
    tiles.emplace_back(fixed(truth->error.rmse, 3) + " m", run.is_metric() ? "ATE, SE(3)" : "ATE, Sim(3)");
  return tiles_html(tiles);
}

}  // namespace

std::string report_html(const ReportInput& in) {
  std::string why_not;
  const std::optional<TruthComparison> truth =
      compare_with_truth(in.run, in.info.ground_truth_path, &why_not);
  std::string body = tiles(in.run, truth) + advice_section(in) + trajectory_section(in, truth, why_not) +
                     epochs_section(in, truth) + map_view_section(in, path_of(in.run, truth)) +
                     edges_section(in) + mask_section(in.info) + map_section(in.run, in.map);
  if (!in.run.frames.empty()) body += tracking_section(in.run) + trust_section(in) + timing_section(in.run);
  body += scale_section(in.run) + parameters_html(in.info.command_line, in.info.params_yaml, in.info.notes);
  return page_html("edgevo run", in.info.source_kind + " " + in.info.source_path, body);
}

}  // namespace edgevo
