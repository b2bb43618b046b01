// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A logistic sum with weights that are not negative, and a bound by split conformal prediction: what
// edgevo_fit_trust is made of.
#include <array>
#include <vector>

#include "edgevo/confidence/motion_confidence.h"

namespace edgevo::training {

/// A motion of ten frames that was evaluated.
struct EvaluatedMotion {
  Inconsistencies doubts{};
  bool is_wrong = false;
  /// Weight in the fit, > 0.
  double weight = 1;
};

/// Log odds of a wrong motion = bias + sum of weight (doubt - usual): weights of the doubts, all at least 0, and
/// their means over right motions.
struct LogisticSum {
  Inconsistencies weights{}, usual{};
  double bias = 0;

  /// Probability of a right motion.
  double p_right(const Inconsistencies& doubts) const;
};

/// Minimises the weighted log loss plus `ridge` times half the square of the weights, by coordinate descent;
/// convex for `unseen` 0, so that the result does not depend on where it begins. Deterministic. `unseen`:
/// share of wrong motions, 0 to 1, that no doubt shows; the others are not weighted as if they had to explain
/// them.
LogisticSum fit_logistic(const std::vector<EvaluatedMotion>& samples, double ridge, double unseen = 0);

/// The value that at most `share` of further values like these are below, by split conformal prediction: the
/// value of rank floor(share (n + 1)), from 1; below all values if that is 0.
double conformal_lower_bound(std::vector<double> values, double share);

}  // namespace edgevo::training
