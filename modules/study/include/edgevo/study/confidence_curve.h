#pragma once
// Does a confidence rank matches rightly? Curves and areas as the stereo literature has them (Hu and Mordohai, "A quantitative
// evaluation of confidence measures for stereo vision", 2012).
#include <vector>

namespace edgevo {

/// A match with what its confidence claims.
struct RankedMatch {
  double confidence = 0;  ///< higher is surer; any unit
  bool is_right = false;  ///< it lies at the true place
};

/// A point of a curve: the matches down to some confidence are kept.
struct CurvePoint {
  double density = 0;     ///< share of all matches that is kept
  double error_rate = 0;  ///< share of the kept ones that is wrong
  double precision = 1;   ///< 1 - error_rate
  double recall = 0;      ///< share of all right ones that is kept
};

/// How well a confidence ranks.
struct ConfidenceCurve {
  std::vector<CurvePoint> points;  ///< by falling confidence; equal confidences enter together
  double error_rate = 0;           ///< of all matches
  double roc_area = 0.5;           ///< chance that a right match ranks above a wrong one; 0.5 says nothing
  double precision_recall_area = 0;  ///< under precision over recall
  double sparsification_area = 0;  ///< under error_rate over density
  double optimal_area = 0;         ///< of the best possible ranking, e + (1 - e) ln(1 - e)
};

/// Empty curve for no matches. Cost: one sort.
ConfidenceCurve rank_by_confidence(std::vector<RankedMatch> matches);

}  // namespace edgevo
