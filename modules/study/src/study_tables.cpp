// SPDX-License-Identifier: BSD-3-Clause
#include "study_tables.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "cell_statistics.h"
#include "edgevo/core/output_file.h"

namespace edgevo {
namespace {

void append_numbers(std::string* text, std::initializer_list<double> values, int decimals) {
  for (const double v : values) *text += "," + fixed(v, decimals);
}

std::string name_of(const StudyCell& cell) { return cell.light + "," + cell.method; }

// Errors of the matches of one kind: with a position along the edge, or on an edge's tangent only.
std::vector<MatchError> errors_of(const StudyCell& cell, bool photometric) {
  std::vector<MatchError> some;
  std::copy_if(cell.errors.begin(), cell.errors.end(), std::back_inserter(some),
               [&](const MatchError& e) { return (e.kind == MatchKind::kPhotometric) == photometric; });
  return some;
}

std::string measure_of(const StudyCell& cell) { return cell.method == "edge_matches" ? "C_d" : "C_m"; }

}  // namespace

std::string curve_table(const StudyResult& result, const std::string& curve) {
  std::string text =
      "light,method,setting,position,pairs,failed,drift_mean_percent,drift_standard_error_percent,drift_"
      "median_percent,rotation_mean_deg,direction_mean_deg,matches,photometric_matches,wrong_share,median_"
      "error_px,match_ms,solve_ms,track_ms\n";
  for (const StudyCell& cell : result.cells) {
    if (cell.curve != curve) continue;
    const CellStatistics s = statistics(cell);
    text += name_of(cell) + "," + cell.setting + "," + std::to_string(cell.position) + "," +
            std::to_string(s.pairs) + "," + std::to_string(s.failed);
    append_numbers(
        &text, {s.drift_mean, s.drift_error, s.drift_median, s.rotation_mean_deg, s.direction_mean_deg}, 4);
    append_numbers(&text, {s.matches, s.photometric}, 1);
    append_numbers(&text, {s.wrong_share, s.median_px}, 4);
    append_numbers(&text, {s.match_ms, s.solve_ms, s.track_ms}, 2);
    text += "\n";
  }
  return text;
}

std::string end_point_table(const StudyResult& result) {
  std::string text =
      "light,method,matches,count,median_px,mean_px,median_normal_px,median_tangent_px,wrong_share\n";
  for (const StudyCell& cell : result.cells) {
    if (cell.curve != "residuals") continue;
    for (const bool photometric : {true, false}) {
      const ErrorSummary s = summarise(errors_of(cell, photometric));
      if (s.count == 0) continue;
      text += name_of(cell) + (photometric ? ",point," : ",tangent,") + std::to_string(s.count);
      append_numbers(&text, {s.median_px, s.mean_px, s.median_normal_px, s.median_tangent_px, s.wrong_share},
                     4);
      text += "\n";
    }
  }
  return text;
}

std::string match_error_table(const StudyResult& result) {
  constexpr int kSteps = 100;  // of the curve, evenly over the logarithm of the error: from 0.02 to 200 px
  std::string text = "light,method,error_px,share\n";
  for (const StudyCell& cell : result.cells) {
    const std::vector<MatchError> errors = errors_of(cell, true);
    if (cell.curve != "residuals" || errors.empty()) continue;
    for (int k = 0; k <= kSteps; ++k) {
      const double limit = 0.02 * std::pow(1e4, double(k) / kSteps);
      const auto count =
          std::count_if(errors.begin(), errors.end(), [&](const MatchError& e) { return e.norm() <= limit; });
      text += name_of(cell);
      append_numbers(&text, {limit, double(count) / double(errors.size())}, 4);
      text += "\n";
    }
  }
  return text;
}

ConfidenceCurve confidence_curve(const StudyCell& cell) {
  std::vector<RankedMatch> ranked;
  const bool is_depth = measure_of(cell) == "C_d";
  for (const MatchError& e : errors_of(cell, !is_depth))
    ranked.push_back(is_depth ? RankedMatch{e.depth_confidence, e.depth_error_px <= kWrongMatchPx}
                              : RankedMatch{e.match_confidence, e.norm() <= kWrongMatchPx});
  return rank_by_confidence(std::move(ranked));
}

std::string confidence_table(const StudyResult& result) {
  constexpr size_t kMaxRows = 200;  // of a curve, evenly over the matches: as many as a plot shows
  std::string text = "light,method,measure,density,error_rate,precision,recall\n";
  for (const StudyCell& cell : result.cells) {
    if (cell.curve != "confidence") continue;
    const ConfidenceCurve curve = confidence_curve(cell);
    const size_t count = std::min(kMaxRows, curve.points.size());
    for (size_t k = 0; k < count; ++k) {
      const CurvePoint& p = curve.points[(k + 1) * curve.points.size() / count - 1];
      text += name_of(cell) + "," + measure_of(cell);
      append_numbers(&text, {p.density, p.error_rate, p.precision, p.recall}, 4);
      text += "\n";
    }
  }
  return text;
}

std::string confidence_area_table(const StudyResult& result) {
  std::string text =
      "light,method,measure,count,error_rate,roc_area,precision_recall_area,sparsification_area,optimal_"
      "area\n";
  for (const StudyCell& cell : result.cells) {
    if (cell.curve != "confidence") continue;
    const ConfidenceCurve c = confidence_curve(cell);
    const size_t count = errors_of(cell, measure_of(cell) == "C_m").size();
    text += name_of(cell) + "," + measure_of(cell) + "," + std::to_string(count);
    append_numbers(
        &text, {c.error_rate, c.roc_area, c.precision_recall_area, c.sparsification_area, c.optimal_area}, 4);
    text += "\n";
  }
  return text;
}

}  // namespace edgevo
