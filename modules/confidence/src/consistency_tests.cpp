// SPDX-License-Identifier: BSD-3-Clause
#include "consistency_tests.h"

#include <algorithm>
#include <cmath>

#include "edgevo/core/motion_tolerance.h"

namespace edgevo {
namespace {

// One camera in ten has another focal length than its file says, or zooms or hunts for its focus, by a tenth
// or so; of the others an estimate shows its own error.
constexpr double kShareOfWrong = 0.1, kErrorOfWrong = 0.1;

double normal_density(double x, double sigma) { return std::exp(-0.5 * x * x / (sigma * sigma)) / sigma; }

// Bayes: it is one of the wrong ones, after an estimate of its error with this standard deviation.
double probability_of_wrong_kind(double error, double sigma) {
  const double wrong = kShareOfWrong * normal_density(error, std::hypot(sigma, kErrorOfWrong)),
               right = (1 - kShareOfWrong) * normal_density(error, sigma);
  return wrong / (wrong + right);
}

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

}  // namespace

double probability_beyond(double mean, double sigma, double tolerance) {
  if (sigma == 0) return std::abs(mean) > tolerance ? 1 : 0;
  return normal_cdf((mean - tolerance) / sigma) + normal_cdf((-mean - tolerance) / sigma);
}

double log_odds(double probability) {
  if (std::isnan(probability)) return probability;
  const double p = std::clamp(probability, kMostCertain, 1 - kMostCertain);
  return std::log(p / (1 - p));
}

double translation_tolerance(double length_depths) {
  return std::max(kMotionTolerance.share_of_depth, kMotionTolerance.share_of_length * length_depths);
}

double evidence_of_corners(const CornerEvidence& c, double length_depths) {
  const double share = translation_tolerance(length_depths) / length_depths;
  const double translation = probability_beyond(c.motion_error, c.motion_sigma, share),
               rotation =
                   probability_beyond(c.rotation_deg, c.rotation_sigma_deg, kMotionTolerance.rotation_deg);
  return log_odds(1 - (1 - rotation) * (std::isnan(translation) ? 1 : 1 - translation));
}

double evidence_of_map(double moved_depths, double length_depths) {
  const double times = moved_depths / translation_tolerance(length_depths);
  return std::isfinite(times) ? std::log(std::max(times, kMostCertain)) : CornerEvidence::kUnknown;
}

double evidence_of_turn(double turn_rad, double length_depths, double error_per_rad) {
  if (!std::isfinite(length_depths)) return CornerEvidence::kUnknown;
  return log_odds(probability_beyond(0, error_per_rad * turn_rad, translation_tolerance(length_depths)));
}

double change_of_step(double step, double usual, double median_depth) {
  const double small = std::isfinite(median_depth) ? kSmallStep * median_depth : 0;
  return std::log((step + small) / (usual + small));
}

double probability_of_wrong_focal_length(double focal_error, double sigma, double turn_deg) {
  const double turn = turn_deg / (1 + focal_error);  // in truth
  const double p = probability_of_wrong_kind(focal_error, sigma) *
                   probability_beyond(focal_error * turn, sigma * turn, kMotionTolerance.rotation_deg);
  return std::isfinite(p) ? p : 0;
}

double probability_of_wrong_zoom(double feigned_depths, double sigma, double length_depths) {
  const double p = probability_of_wrong_kind(feigned_depths, sigma) *
                   probability_beyond(feigned_depths, sigma, translation_tolerance(length_depths));
  return std::isfinite(p) ? p : 0;
}

}  // namespace edgevo
