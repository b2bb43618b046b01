// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/study/confidence_curve.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

// e + (1 - e) ln(1 - e): all right matches first (Hu and Mordohai).
double optimal_area(double e) { return e < 1 ? e + (1 - e) * std::log(1 - e) : 1; }

}  // namespace

ConfidenceCurve rank_by_confidence(std::vector<RankedMatch> matches) {
  ConfidenceCurve curve;
  if (matches.empty()) return curve;
  std::stable_sort(matches.begin(), matches.end(),
                   [](const RankedMatch& a, const RankedMatch& b) { return a.confidence > b.confidence; });
  const double n = double(matches.size());
  const double right =
      double(std::count_if(matches.begin(), matches.end(), [](const RankedMatch& m) { return m.is_right; }));
  const double wrong = n - right;
  curve.error_rate = wrong / n;
  curve.optimal_area = optimal_area(curve.error_rate);
  double kept_right = 0, kept = 0, right_above_wrong = 0;
  CurvePoint before;
  for (size_t i = 0; i < matches.size();) {
    double group_right = 0, group = 0;
    const double confidence = matches[i].confidence;
    for (; i < matches.size() && matches[i].confidence == confidence; ++i)
      ++group, group_right += matches[i].is_right;
    right_above_wrong += (group - group_right) * (kept_right + 0.5 * group_right);  // equal ones count half
    kept += group, kept_right += group_right;
    CurvePoint p;
    p.density = kept / n;
    p.error_rate = (kept - kept_right) / kept;
    p.precision = 1 - p.error_rate;
    p.recall = right > 0 ? kept_right / right : 0;
    if (curve.points.empty()) before = {0, p.error_rate, p.precision, 0};
    curve.sparsification_area += (p.density - before.density) * 0.5 * (p.error_rate + before.error_rate);
    curve.precision_recall_area += (p.recall - before.recall) * 0.5 * (p.precision + before.precision);
    curve.points.push_back(p);
    before = p;
  }
  if (right > 0 && wrong > 0) curve.roc_area = right_above_wrong / (right * wrong);
  return curve;
}

}  // namespace edgevo
