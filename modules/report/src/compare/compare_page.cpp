// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/report/compare_page.h"

#include <algorithm>
#include <limits>

#include "edgevo/core/output_file.h"
#include "edgevo/report/page.h"
#include "edgevo/report/palette.h"
#include "edgevo/report/plan.h"
#include "run_figures.h"
#include "run_table.h"
#include "small_path.h"

namespace edgevo {
namespace {

constexpr size_t kMaxDrawings = 30;  // ground truths with a drawing
constexpr size_t kMaxLines = 40;     // lines of one drawing: more cannot be distinguished
constexpr size_t kMaxNamed = 8;      // lines with a colour of their own
constexpr size_t kMaxPoints = 400;   // points of a line

using Group = std::vector<const RunFigures*>;  // runs with the same truth, the worst first

std::vector<RunFigures> worst_first(const std::vector<ComparedRun>& runs) {
  std::vector<RunFigures> figures;
  GroundTruths truths;
  for (const ComparedRun& run : runs) figures.push_back(figures_of(run, &truths));
  std::stable_sort(figures.begin(), figures.end(), is_worse);
  return figures;
}

std::vector<Group> groups_of(const std::vector<RunFigures>& figures) {
  std::vector<Group> groups;
  for (const RunFigures& f : figures) {
    if (!f.evaluation) continue;
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const Group& g) { return g.front()->truth == f.truth; });
    if (group == groups.end()) group = groups.insert(groups.end(), Group());
    group->push_back(&f);
  }
  return groups;
}

PlanLine line_of(const std::string& name, const char* color, const GroundPath& path) {
  return {name, color, false, {thinned(path, kMaxPoints)}};
}

// Draws all runs of a small group, or the worst and the best of a large one, in colours of their own; the
// others pale below them.
Plan plan_of(const Group& group) {
  static const char* const kColors[kMaxNamed] = {palette::kRed,    palette::kOrange, palette::kAmber,
                                                 palette::kPurple, palette::kViolet, palette::kTeal,
                                                 palette::kGreen,  palette::kBlue};
  Plan plan{"m", {}, {}};
  const size_t drawn = std::min(group.size(), kMaxLines);
  const bool all_named = drawn <= kMaxNamed;
  for (size_t i = 1; !all_named && i + 1 < drawn; ++i)
    plan.lines.push_back(line_of(i == 1 ? "others" : "", palette::kPaleBlue, group[i]->path));
  plan.lines.push_back(line_of("ground truth", palette::kInk, group.front()->truth_path));
  for (size_t i = drawn; i-- > 0;) {
    const bool named = all_named || i == 0 || i + 1 == drawn;
    if (named)
      plan.lines.push_back(
          line_of(group[i]->run->name, kColors[i == 0 ? 0 : std::min(i, kMaxNamed - 1)], group[i]->path));
  }
  return plan;
}

// The name of a single run, or the common source, if any, and the number of runs.
std::string title_of(const Group& group) {
  if (group.size() == 1) return group.front()->run->name;
  const std::string& source = group.front()->run->source;
  const bool same =
      std::all_of(group.begin(), group.end(), [&](const auto* f) { return f->run->source == source; });
  return (same && !source.empty() ? source + ": " : "") + std::to_string(group.size()) +
         " runs with one ground truth";
}

std::string overlay_section(const Group& group, size_t number) {
  std::string body = draw(plan_of(group));
  body += note_html(
      "Each path is aligned with the truth by its own Sim(3); forward is the initial viewing direction of "
      "the true camera." +
      std::string(group.size() > kMaxLines ? " Drawn are the " + std::to_string(kMaxLines) + " worst." : ""));
  return section_html("paths" + std::to_string(number), title_of(group), body);
}

double median_ate_percent(const std::vector<RunFigures>& figures) {
  std::vector<double> values;
  for (const RunFigures& f : figures)
    if (f.ate_percent() == f.ate_percent()) values.push_back(f.ate_percent());
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  return 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}

std::string tiles(const std::vector<RunFigures>& figures) {
  const auto count = [&](auto holds) {
    return std::to_string(std::count_if(figures.begin(), figures.end(), holds));
  };
  std::vector<std::pair<std::string, std::string>> tiles{
      {std::to_string(figures.size()), figures.size() == 1 ? "run" : "runs"},
      {count([](const RunFigures& f) { return f.evaluation.has_value(); }), "compared with ground truth"},
      {count([](const RunFigures& f) { return !f.run->problem.empty() || !f.note.empty(); }),
       "with problems"},
      {count([](const RunFigures& f) { return f.run->segments > 1; }), "in more than one segment"}};
  if (const double median = median_ate_percent(figures); median == median)
    tiles.emplace_back(fixed(median, 3) + " %", "median ATE, of the path");
  return tiles_html(tiles);
}

}  // namespace

std::string compare_html(const std::vector<ComparedRun>& runs) {
  const std::vector<RunFigures> figures = worst_first(runs);
  std::string body =
      tiles(figures) +
      section_html("runs", "Runs, the worst first",
                   note_html("Click a heading to sort by it. Figures are those of edgevo eval; the worst run "
                             "has the largest error relative to its path.") +
                       run_table_html(figures));
  const std::vector<Group> groups = groups_of(figures);
  for (size_t i = 0; i < std::min(groups.size(), kMaxDrawings); ++i)
    body += overlay_section(groups[i], i + 1);
  return page_html("edgevo compare", std::to_string(runs.size()) + (runs.size() == 1 ? " run" : " runs"),
                   body);
}

}  // namespace edgevo
