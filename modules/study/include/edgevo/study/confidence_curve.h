// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How well a confidence ranks matches: curves and areas as used in the stereo literature (Hu and Mordohai, "A
// quantitative evaluation of confidence measures for stereo vision", 2012).
#include <vector>

namespace edgevo {

/// A match and its confidence.
struct RankedMatch {
  /// Confidence of the match, any unit; higher is more certain.
  double confidence = 0;
  /// True if the match is correct.
  bool is_right = false;
};

/// One point of a curve, where the matches above some confidence are kept.
struct CurvePoint {
  /// Share of all matches that are kept, 0 to 1.
  double density = 0;
  /// Share of the kept matches that are wrong, 0 to 1.
  double error_rate = 0;
  /// Precision, 1 - error_rate.
  double precision = 1;
  /// Share of all correct matches that are kept, 0 to 1.
  double recall = 0;
};

/// Curve and areas that describe how well a confidence ranks matches.
struct ConfidenceCurve {
  /// Points by falling confidence; equal confidences enter together.
  std::vector<CurvePoint> points;
  /// Share of all matches that are wrong, 0 to 1.
  double error_rate = 0;
  /// Probability that a correct match ranks above a wrong one; 0.5 is uninformative.
  double roc_area = 0.5;
  /// Area under precision over recall.
  double precision_recall_area = 0;
  /// Area under error_rate over density.
  double sparsification_area = 0;
  /// Sparsification area of the best possible ranking, e + (1 - e) ln(1 - e).
  double optimal_area = 0;
};

/// Curve of the matches; empty for no matches. Cost: one sort.
ConfidenceCurve rank_by_confidence(std::vector<RankedMatch> matches);

}  // namespace edgevo
