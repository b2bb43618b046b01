// SPDX-License-Identifier: BSD-3-Clause
#include "monotone_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

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

struct Bin {
  double weight = 0, right = 0, sum = 0;
  double p_right() const { return right / weight; }
};

std::vector<Bin> binned(const LogisticSum& fit, const std::vector<EvaluatedMotion>& samples, int bins) {
  std::vector<std::pair<double, const EvaluatedMotion*>> sorted;
  double total = 0;
  for (const EvaluatedMotion& s : samples) sorted.emplace_back(fit.sum(s.doubts), &s), total += s.weight;
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<double> ends;
  for (int b = 1; b < bins; ++b) ends.push_back(0.9 * b / (bins - 1));
  for (int b = 1; b <= bins; ++b) ends.push_back(0.9 + 0.1 * b / bins);
  std::vector<Bin> out(1);
  double seen = 0;
  size_t end = 0;
  for (const auto& [sum, sample] : sorted) {
    if (end + 1 < ends.size() && seen > ends[end] * total) {
      if (out.back().weight > 0) out.emplace_back();
      while (end + 1 < ends.size() && seen > ends[end] * total) ++end;
    }
    Bin& bin = out.back();
    bin.weight += sample->weight, bin.sum += sample->weight * sum;
    if (!sample->is_wrong) bin.right += sample->weight;
    seen += sample->weight;
  }
  if (out.back().weight == 0) out.pop_back();
  return out;
}

}  // namespace

double LogisticSum::sum(const Inconsistencies& doubts) const {
  return std::inner_product(doubts.begin(), doubts.end(), weights.begin(), 0.0);
}

LogisticSum fit_logistic(const std::vector<EvaluatedMotion>& samples, double ridge, double unseen) {
  LogisticSum fit;
  std::vector<double> z(samples.size(), 0);
  for (int round = 0; round < 300; ++round) {
    double largest = 0;
    const double shift = std::clamp(newton_step(
                                        samples, z, unseen, [](size_t) { return 1.0; }, 0, 0),
                                    -1.0, 1.0);
    fit.bias += shift, largest = std::abs(shift);
    for (double& value : z) value += shift;
    for (size_t k = 0; k < kConsistencyTests; ++k) {
      const auto doubt = [&](size_t i) { return samples[i].doubts[k]; };
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

std::vector<Knot> calibrate(const LogisticSum& fit, const std::vector<EvaluatedMotion>& samples, int bins) {
  std::vector<Bin> pools;
  for (const Bin& bin : binned(fit, samples, bins)) {
    pools.push_back(bin);
    while (pools.size() > 1 && pools.back().p_right() >= pools[pools.size() - 2].p_right()) {
      Bin& before = pools[pools.size() - 2];
      before.weight += pools.back().weight, before.right += pools.back().right,
          before.sum += pools.back().sum;
      pools.pop_back();
    }
  }
  std::vector<Knot> knots;
  for (const Bin& pool : pools)
    knots.push_back({pool.sum / pool.weight, std::clamp(pool.p_right(), 0.005, 0.995)});
  return knots;
}

double p_right_at(const std::vector<Knot>& knots, double sum) {
  return edgevo::p_right_at(knots.data(), knots.size(), sum);
}

double conformal_lower_bound(std::vector<double> values, double share) {
  const auto rank = size_t(std::floor(share * double(values.size() + 1)));
  if (rank == 0) return -1;
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(rank - 1), values.end());
  return values[rank - 1];
}

}  // namespace edgevo::training
