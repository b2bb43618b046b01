// SPDX-License-Identifier: BSD-3-Clause
#include "monotone_fit.h"

#include <algorithm>
#include <cmath>

namespace edgevo::training {
namespace {

double sigmoid(double z) { return 1 / (1 + std::exp(-z)); }

// Derivative of the log loss by the log odds, of which p is the probability.
double slope_of(bool is_wrong, double p, double unseen) {
  return is_wrong ? -(1 - unseen) * p * (1 - p) / (unseen + (1 - unseen) * p) : p;
}

// Newton's step in one coordinate, whose value in each sample is `value(i)`.
template <class Value>
double newton_step(const std::vector<EvaluatedMotion>& samples, const std::vector<double>& z, double unseen,
                   Value value, double slope, double curvature) {
  for (size_t i = 0; i < samples.size(); ++i) {
    const double x = value(i);
    if (x == 0) continue;
    const double p = sigmoid(z[i]), w = samples[i].weight;
    slope += w * slope_of(samples[i].is_wrong, p, unseen) * x;
    curvature += w * std::max(p * (1 - p), 1e-4) * x * x;
  }
  return curvature > 0 ? -slope / curvature : 0;
}

Inconsistencies mean_of_right(const std::vector<EvaluatedMotion>& samples) {
  Inconsistencies mean{};
  double weight = 0;
  for (const EvaluatedMotion& s : samples) {
    if (s.is_wrong) continue;
    weight += s.weight;
    for (size_t k = 0; k < kConsistencyTests; ++k) mean[k] += s.weight * s.doubts[k];
  }
  for (double& m : mean) m /= std::max(weight, 1e-9);
  return mean;
}

}  // namespace

double LogisticSum::p_right(const Inconsistencies& doubts) const {
  double odds = bias;
  for (size_t k = 0; k < kConsistencyTests; ++k) odds += weights[k] * (doubts[k] - usual[k]);
  return 1 - sigmoid(odds);
}

LogisticSum fit_logistic(const std::vector<EvaluatedMotion>& samples, double ridge, double unseen) {
  LogisticSum fit;
  fit.usual = mean_of_right(samples);
  std::vector<double> z(samples.size(), 0);
  for (int round = 0; round < 300; ++round) {
    double largest = 0;
    const double shift = std::clamp(newton_step(
                                        samples, z, unseen, [](size_t) { return 1.0; }, 0, 0),
                                    -1.0, 1.0);
    fit.bias += shift, largest = std::abs(shift);
    for (double& value : z) value += shift;
    for (size_t k = 0; k < kConsistencyTests; ++k) {
      const auto doubt = [&](size_t i) { return samples[i].doubts[k] - fit.usual[k]; };
      const double step = newton_step(samples, z, unseen, doubt, ridge * fit.weights[k], ridge);
      const double weight = std::max(0.0, fit.weights[k] + std::clamp(step, -1.0, 1.0));
      const double change = weight - fit.weights[k];
      fit.weights[k] = weight, largest = std::max(largest, std::abs(change));
      if (change != 0)
        for (size_t i = 0; i < z.size(); ++i) z[i] += change * doubt(i);
    }
    if (largest < 1e-5) break;
  }
  return fit;
}

double conformal_lower_bound(std::vector<double> values, double share) {
  const auto rank = size_t(std::floor(share * double(values.size() + 1)));
  if (rank == 0) return -1;
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(rank - 1), values.end());
  return values[rank - 1];
}

}  // namespace edgevo::training
