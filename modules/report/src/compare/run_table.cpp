// SPDX-License-Identifier: BSD-3-Clause
#include "run_table.h"

#include <functional>
#include <limits>

#include "assets.h"
#include "edgevo/core/output_file.h"
#include "edgevo/report/page.h"
#include "small_path.h"

namespace edgevo {
namespace {

constexpr size_t kShown = 200;  // rows shown at first; a click shows more
constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

struct Column {
  const char *name, *unit, *help;
  int decimals;
  std::function<double(const RunFigures&)> value;  // NaN: none
};

double if_evaluated(const RunFigures& f, const std::function<double(const TrajectoryEvaluation&)>& value) {
  return f.evaluation ? value(*f.evaluation) : kNoValue;
}

const std::vector<Column>& columns() {
  static const std::vector<Column> all{
      {"frames", "", "frames processed", 0, [](const RunFigures& f) { return f.run->frames; }},
      {"with pose", "%", "share of the frames", 1,
       [](const RunFigures& f) { return f.completion_percent(); }},
      {"ATE", "m", "RMSE after Sim(3)", 4,
       [](const RunFigures& f) { return if_evaluated(f, [](const auto& e) { return e.ate_sim3.rmse; }); }},
      {"ATE", "% of path", "RMSE relative to the length of the true path", 3,
       [](const RunFigures& f) { return f.ate_percent(); }},
      {"drift", "cm/m", "mean over intervals, scale re-corrected every 200 frames", 2,
       [](const RunFigures& f) {
         return if_evaluated(f, [](const auto& e) { return e.drift ? e.drift->mean_cm_per_m : kNoValue; });
       }},
      {"scale", "m/unit", "metres per unit of the run", 4,
       [](const RunFigures& f) { return if_evaluated(f, [](const auto& e) { return e.ate_sim3.scale; }); }},
      {"scale drift", "x", "scale at the end divided by that at the start", 4,
       [](const RunFigures& f) { return f.scale_drift(); }},
      {"CPU", "ms", "CPU time of the odometry a frame", 1, [](const RunFigures& f) { return f.run->cpu_ms; }},
      {"keyframes", "", "", 0, [](const RunFigures& f) { return f.run->keyframes; }},
      {"lost", "frames", "frames without a pose after the first with one", 0,
       [](const RunFigures& f) { return f.run->lost; }},
      {"segments", "", "more than one: the map was lost and a new one was started", 0,
       [](const RunFigures& f) { return f.run->segments; }},
  };
  return all;
}

std::string sort_button(const std::string& name, const std::string& unit, const std::string& help) {
  return "<th scope=\"col\"><button type=\"button\"" +
         (help.empty() ? "" : " title=\"" + html_escaped(help) + "\"") + ">" + html_escaped(name) +
         (unit.empty() ? "" : "<br>" + html_escaped(unit)) + "</button></th>";
}

std::string header() {
  std::string html = "<thead><tr><th scope=\"col\">path</th>" + sort_button("run", "", "");
  for (const Column& c : columns()) html += sort_button(c.name, c.unit, c.help);
  return html + "</tr></thead>\n";
}

std::string name_of(const ComparedRun& run) {
  const std::string name = html_escaped(run.name);
  const std::string link =
      run.link.empty() ? name : "<a href=\"" + html_escaped(run.link) + "\">" + name + "</a>";
  return link +
         (run.name.rfind(run.source, 0) == 0 ? "" : "<br><small>" + html_escaped(run.source) + "</small>");
}

std::string cell(const Column& column, const RunFigures& f) {
  const double value = column.value(f);
  if (value != value) return "<td>-</td>";
  return "<td data-value=\"" + fixed(value, 9) + "\">" + fixed(value, column.decimals) + "</td>";
}

std::string figures_row(const RunFigures& f) {
  std::string html;
  for (const Column& c : columns()) html += cell(c, f);
  return html;
}

std::string problem_row(const std::string& problem) {
  return "<td class=\"bad\" colspan=\"" + std::to_string(columns().size()) + "\">" + html_escaped(problem) +
         "</td>";
}

std::string row(const RunFigures& f, bool shown) {
  const ComparedRun& run = *f.run;
  return std::string(shown ? "<tr>" : "<tr hidden>") + "<td class=\"small\">" +
         small_path_svg(f.path, f.truth_path) + "</td><td data-value=\"" + html_escaped(run.name) + "\">" +
         name_of(run) +
         (f.note.empty() ? "" : "<br><span class=\"bad\">" + html_escaped(f.note) + "</span>") + "</td>" +
         (run.problem.empty() ? figures_row(f) : problem_row(run.problem)) + "</tr>\n";
}

}  // namespace

std::string run_table_html(const std::vector<RunFigures>& runs) {
  std::string html = "<div class=\"table\"><table class=\"runs\" data-shown=\"" + std::to_string(kShown) +
                     "\">" + header() + "<tbody>\n";
  for (size_t i = 0; i < runs.size(); ++i) html += row(runs[i], i < kShown);
  html += "</tbody></table></div>\n";
  if (runs.size() > kShown)
    html +=
        "<button type=\"button\" class=\"more\">show "
        "more</button>\n<noscript><style>tr[hidden]{display:table-row}</style></noscript>\n";
  return html + "<script>" + assets::kCompareJs + "</script>\n";
}

}  // namespace edgevo
