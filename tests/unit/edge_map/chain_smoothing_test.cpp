// SPDX-License-Identifier: BSD-3-Clause
// Smoothing along an edge: it reduces noise where the edge is straight, and preserves bends.
#include "chain_smoothing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

constexpr double kSigma = 0.01;

template <class Shape>
std::vector<ChainValue> noisy(const Shape& shape, int count, uint64_t seed) {
  Random random(seed);
  std::vector<ChainValue> values;
  for (int i = 0; i < count; ++i) {
    const double at = 3.0 * i;
    values.push_back({at, shape(at) + kSigma * random.normal(), kSigma * kSigma, 0});
  }
  return values;
}

template <class Shape>
double rms_error(const std::vector<ChainValue>& values, const Shape& shape) {
  const std::vector<SmoothValue> smooth = smooth_chain(values);
  double sum = 0;
  for (size_t i = 0; i < values.size(); ++i) sum += std::pow(smooth[i].value - shape(values[i].at), 2);
  return std::sqrt(sum / double(values.size()));
}

TEST(ChainSmoothing, AStraightPieceIsAveraged) {
  const auto straight = [](double at) { return 0.2 + 0.001 * at; };
  // Windows of 43 values: a line fit has a standard deviation of 1/sqrt(43) in its middle.
  EXPECT_LT(rms_error(noisy(straight, 200, 1), straight), 0.25 * kSigma);
}

TEST(ChainSmoothing, ACornerStaysWhereItIs) {
  const auto corner = [](double at) { return 0.2 + 0.02 * std::abs(at - 300); };
  EXPECT_LT(rms_error(noisy(corner, 200, 2), corner), 1.5 * kSigma);
  std::vector<ChainValue> values = noisy(corner, 200, 3);
  EXPECT_NEAR(smooth_chain(values)[100].value, corner(300), 0.1);  // 64 px to both sides would lift it by 0.6
}

TEST(ChainSmoothing, TheStandardDeviationMatchesTheError) {
  const auto straight = [](double at) { return 1 - 0.002 * at; };
  double sum = 0;
  int count = 0;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<ChainValue> values = noisy(straight, 60, seed);
    for (size_t i = 0; i < values.size(); ++i) {
      const SmoothValue s = smooth_chain(values)[i];
      sum += std::pow((s.value - straight(values[i].at)) / s.sigma, 2);
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(sum / count), 1, 0.25);
}

TEST(ChainSmoothing, AValueWithoutInformationTakesThatOfItsNeighbours) {
  std::vector<ChainValue> values;
  for (int i = 0; i < 20; ++i)
    values.push_back({3.0 * i, i < 8 || i > 11 ? 0.1 * i : 77.0, i < 8 || i > 11 ? 1e-6 : 0, 0});
  const std::vector<SmoothValue> smooth = smooth_chain(values);
  for (int i = 8; i <= 11; ++i) EXPECT_NEAR(smooth[size_t(i)].value, 0.1 * i, 1e-6) << i;
}

TEST(ChainSmoothing, ACommonErrorIsNotAveragedOut) {
  std::vector<ChainValue> values;
  for (int i = 0; i < 100; ++i) values.push_back({3.0 * i, 0.5, 1e-6, 0.02});
  EXPECT_GE(smooth_chain(values)[50].sigma, 0.02);
}

TEST(ChainSmoothing, OneValueAndNone) {
  EXPECT_TRUE(smooth_chain({}).empty());
  const std::vector<SmoothValue> one = smooth_chain({{5, 0.3, 0.04, 0}});
  EXPECT_EQ(one[0].value, 0.3);
  EXPECT_NEAR(one[0].sigma, 0.2, 1e-12);
}

}  // namespace
}  // namespace edgevo
