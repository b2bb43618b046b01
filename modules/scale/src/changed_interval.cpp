// SPDX-License-Identifier: BSD-3-Clause
#include "changed_interval.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

constexpr size_t kSteps = 64;  // places where an interval may begin: finer costs the square of it

}  // namespace

IndexInterval changed_interval(const std::vector<Eigen::Vector3d>& values) {
  const size_t n = values.size(), steps = std::min(n, kSteps);
  std::vector<size_t> places;
  for (size_t k = 0; k <= steps; ++k) places.push_back(steps > 0 ? k * n / steps : 0);
  std::vector<Eigen::Vector3d> sums{Eigen::Vector3d::Zero()};  // before each place
  for (size_t k = 0; k < steps; ++k) {
    sums.push_back(sums.back());
    for (size_t i = places[k]; i < places[k + 1]; ++i) sums.back() += values[i];
  }
  IndexInterval best;
  double best_square = 0;
  for (size_t a = 0; a < steps; ++a)
    for (size_t b = a + 1; b <= steps; ++b) {
      const double share = double(places[b] - places[a]) / double(n);
      if (share >= 1) continue;
      const double square = (sums[b] - sums[a] - share * sums[steps]).squaredNorm() / (share * (1 - share));
      if (square > best_square) best_square = square, best = {places[a], places[b]};
    }
  return best;
}

double gain_by_chance(double values, double axes) { return (4 + axes) * std::log(values); }

bool stands_out(const IndexInterval& interval, const std::vector<Eigen::Vector3d>& values) {
  const double n = double(values.size()), inside = double(interval.end - interval.begin);
  double sum = 0, squares = 0, sum_inside = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    const double x = values[i].x();
    sum += x, squares += x * x;
    if (i >= interval.begin && i < interval.end) sum_inside += x;
  }
  const double outside = n - inside, sum_outside = sum - sum_inside;
  if (!(inside > 0) || !(outside > 0)) return false;
  const double one_mean = squares - sum * sum / n;
  const double two_means = squares - sum_inside * sum_inside / inside - sum_outside * sum_outside / outside;
  return n * std::log(one_mean / two_means) > gain_by_chance(n, 1);
}

}  // namespace edgevo
