// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A logistic sum with weights that are not negative, its calibration by isotonic regression, and a bound by
// split conformal prediction: what edgevo_fit_trust is made of.
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

/// Weights of the doubts, all at least 0, and the bias: log odds of a wrong motion = bias + sum.
struct LogisticSum {
  Inconsistencies weights{};
  double bias = 0;

  /// The sum without the bias.
  double sum(const Inconsistencies& doubts) const;
};

/// Minimises the weighted log loss plus `ridge` times half the square of the weights, by coordinate descent;
/// convex for `unseen` 0, so that the result does not depend on where it begins. Deterministic. `unseen`:
/// share of wrong motions, 0 to 1, that no doubt shows; the others are not weighted as if they had to explain
/// them.
LogisticSum fit_logistic(const std::vector<EvaluatedMotion>& samples, double ridge, double unseen = 0);

using Knot = CalibrationKnot;
/// Isotonic regression of "right" on the sum: the samples in bins of equal weight (`bins` of them, and as
/// many again in the upper tenth), pooled until p_right does not rise with the sum. p_right stays within
/// 0.005 and 0.995. Knots of ascending sum; equal neighbours are excluded.
std::vector<Knot> calibrate(const LogisticSum& fit, const std::vector<EvaluatedMotion>& samples, int bins);
/// As edgevo::p_right_at().
double p_right_at(const std::vector<Knot>& knots, double sum);

/// The value that at most `share` of further values like these are below, by split conformal prediction: the
/// value of rank floor(share (n + 1)), from 1; below all values if that is 0.
double conformal_lower_bound(std::vector<double> values, double share);

}  // namespace edgevo::training
