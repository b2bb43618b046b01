// SPDX-License-Identifier: BSD-3-Clause
#include "epochs_section.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "edgevo/core/output_file.h"
#include "edgevo/report/page.h"
#include "edgevo/report/palette.h"
#include "edgevo/report/plan.h"

namespace edgevo {
namespace {

using Points = std::vector<std::pair<double, double>>;

constexpr size_t kMaxRows = 20;

// Positions from above, by index in the source.
std::map<int, std::pair<double, double>> positions_by_frame(const Run& run, const ShownPath& path) {
  std::map<int, std::pair<double, double>> positions;
  for (size_t i = 0; i < run.frames.size(); ++i)
    if (const auto& p = path.estimate[i]) positions[run.frames[i].index] = {p->x(), p->y()};
  return positions;
}

// The path, in two colours that alternate from epoch to epoch.
void add_epochs(const Run& run, const ShownPath& path, Plan* plan) {
  PlanLine lines[] = {{"epochs", palette::kBlue, false, {}}, {"", palette::kTeal, false, {}}};
  const auto positions = positions_by_frame(run, path);
  for (size_t e = 0; e < run.epochs.size(); ++e) {
    Points piece;
    for (auto p = positions.lower_bound(run.epochs[e].first_frame);
         p != positions.end() && p->first <= run.epochs[e].last_frame; ++p)
      piece.push_back(p->second);
    if (!piece.empty()) lines[e % 2].pieces.push_back(std::move(piece));
  }
  for (PlanLine& line : lines) plan->lines.push_back(std::move(line));
}

const char* color_of(const std::string& kind) {
  if (kind == "features") return palette::kPurple;
  if (kind == "ground") return palette::kOlive;
  if (kind == "metric") return palette::kOrange;
  return palette::kViolet;
}

// From one camera to the other, by kind; those that do not count are dashed.
void add_links(const Run& run, const ShownPath& path, Plan* plan) {
  const auto positions = positions_by_frame(run, path);
  std::map<std::string, PlanLine> lines;
  PlanLine mistaken{"contradicted by the others", palette::kRed, true, {}};
  for (const ConstraintRecord& c : run.constraints) {
    const auto from = positions.find(c.from_frame), to = positions.find(c.to_frame);
    if (from == positions.end() || to == positions.end()) continue;
    PlanLine& line = c.holds ? lines[c.kind] : mistaken;
    line.pieces.push_back({from->second, to->second});
  }
  for (auto& [kind, line] : lines) {
    line.name = "linked by " + kind, line.color = color_of(kind);
    plan->lines.push_back(std::move(line));
  }
  if (!mistaken.pieces.empty()) plan->lines.push_back(std::move(mistaken));
}

std::string frames_in_words(int first, int last) {
  return (first < 0 ? "the map" : std::to_string(first)) + " to " + std::to_string(last);
}
std::string ratio_in_words(double ratio) { return std::isfinite(ratio) ? fixed(ratio, 3) : ""; }
std::string sigma_in_words(double sigma) { return std::isfinite(sigma) ? fixed(100 * sigma, 1) + " %" : ""; }

std::string more_than_shown(size_t rows) {
  return rows <= kMaxRows ? ""
                          : note_html("The first " + std::to_string(kMaxRows) + " of " +
                                      std::to_string(rows) + "; all of them: graph.csv.");
}

std::string epoch_table(const Run& run) {
  std::vector<std::vector<std::string>> rows;
  for (size_t i = 0; i < std::min(kMaxRows, run.epochs.size()); ++i) {
    const EpochRecord& e = run.epochs[i];
    rows.push_back({frames_in_words(e.first_frame, e.last_frame), std::to_string(e.segment),
                    ratio_in_words(e.scale), sigma_in_words(e.scale_sigma)});
  }
  return table_html({"frames", "segment", "length in the run over length measured", "sigma"}, rows) +
         more_than_shown(run.epochs.size());
}

std::string link_table(const Run& run) {
  std::vector<std::vector<std::string>> rows;
  for (size_t i = 0; i < std::min(kMaxRows, run.constraints.size()); ++i) {
    const ConstraintRecord& c = run.constraints[i];
    const bool measures_unit = std::isfinite(c.scale_sigma);
    rows.push_back({c.kind, frames_in_words(c.from_frame, c.to_frame),
                    measures_unit ? ratio_in_words(c.scale) : "", sigma_in_words(c.scale_sigma),
                    c.holds ? "yes" : "no"});
  }
  if (rows.empty()) return note_html("Nothing was found that relates them.");
  return table_html({"what", "frames", "ratio of the units", "sigma", "counts"}, rows) +
         more_than_shown(run.constraints.size());
}

}  // namespace

std::string epochs_section(const ReportInput& in, const std::optional<TruthComparison>& truth) {
  const Run& run = in.run;
  if (run.epochs.size() < 2 && run.constraints.empty()) return "";
  const ShownPath path = path_of(run, truth);
  Plan plan{path.unit, {}, {}};
  add_epochs(run, path, &plan);
  add_links(run, path, &plan);
  return section_html(
      "epochs", "Units of length",
      note_html(
          "An epoch is an interval within which the unit of length is one. A doubt or a new map ends it; "
          "what relates two of them is kept, and all are placed together.") +
          draw(plan) + "<h3>Epochs</h3>\n" + epoch_table(run) + "<h3>What relates them</h3>\n" +
          link_table(run));
}

}  // namespace edgevo
