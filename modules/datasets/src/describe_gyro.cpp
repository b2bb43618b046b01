// SPDX-License-Identifier: BSD-3-Clause
// What `edgevo info` says of a gyro.
#include <algorithm>
#include <cmath>
#include <limits>

#include "edgevo/core/angle.h"
#include "edgevo/core/formatted.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/output_file.h"
#include "edgevo/datasets/gyro_file.h"
#include "edgevo/gyro/gyro_integrator.h"

namespace edgevo {
namespace {

std::vector<double> steps_of(const std::vector<GyroSample>& samples) {
  std::vector<double> steps;
  for (size_t i = 1; i < samples.size(); ++i)
    steps.push_back(seconds_between(samples[i - 1].time, samples[i].time));
  return steps;
}

std::string gaps_in_words(const std::vector<double>& steps, double usual) {
  constexpr double kGap = 2.5;  // usual steps, as with images
  const auto gaps = std::count_if(steps.begin(), steps.end(), [&](double s) { return s > kGap * usual; });
  if (gaps == 0) return "no gaps";
  return std::to_string(gaps) + " gaps, the longest of " +
         fixed(*std::max_element(steps.begin(), steps.end()), 3) + " s";
}

// What the odometry's own counts say of the samples.
std::string faults_in_words(const std::vector<GyroSample>& samples) {
  GyroIntegrator gyro;
  double repeated_s = 0;
  std::vector<double> noises;
  for (const GyroSample& sample : samples) {
    gyro.add(sample);
    if (gyro.noise() > 0) noises.push_back(gyro.noise());
    if (!gyro.rests(sample.rate)) repeated_s = std::max(repeated_s, gyro.repeated_s());
  }
  std::string words;
  if (!noises.empty()) words += formatted(", noise %.4f degrees/s/sqrt(Hz)", deg(median(std::move(noises))));
  if (gyro.missing() > 0)
    words += formatted(", %d samples missing (%.1f %%)", gyro.missing(), 100 * gyro.missing_share());
  if (gyro.spikes() > 0) words += formatted(", %d spikes", gyro.spikes());
  if (const ClippedRates* axis = gyro.clipped())
    words += formatted(", clipped at %.3g degrees/s (%.1f %%)", deg(axis->limit()), 100 * axis->share());
  if (repeated_s >= kStuckS) words += formatted(", stuck for %.1f s", repeated_s);
  return words;
}

// Mean rate of the second in which it varies least: nearly the bias, if it was at rest then.
struct Calmest {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  double deviation = std::numeric_limits<double>::infinity();
};

Calmest calmest_second(const std::vector<GyroSample>& samples, double step) {
  const size_t n = std::max<size_t>(2, size_t(std::lround(1 / step)));
  Calmest calmest;
  for (size_t begin = 0; begin + n <= samples.size(); begin += n / 2) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (size_t i = begin; i < begin + n; ++i) mean += samples[i].rate / double(n);
    double square = 0;
    for (size_t i = begin; i < begin + n; ++i) square += (samples[i].rate - mean).squaredNorm() / double(n);
    if (std::sqrt(square / 3) < calmest.deviation) calmest = {mean, std::sqrt(square / 3)};
  }
  return calmest;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> describe_gyro(const GyroReadings& readings) {
  if (!readings) return {};
  std::vector<GyroSample> samples;
  while (const auto sample = readings()) samples.push_back(*sample);
  if (samples.size() < 2) return {};
  const std::vector<double> steps = steps_of(samples);
  const double usual = median(steps);
  if (!(usual > 0)) return {{"gyro", std::to_string(samples.size()) + " samples without usable times"}};
  std::vector<std::pair<std::string, std::string>> lines{
      {"gyro", std::to_string(samples.size()) + " samples, " + fixed(1 / usual, 1) + " Hz, " +
                   gaps_in_words(steps, usual) + faults_in_words(samples)}};
  const Calmest calmest = calmest_second(samples, usual);
  if (!std::isfinite(calmest.deviation)) return lines;
  std::string rates;
  for (const double value : calmest.mean) rates += (rates.empty() ? "" : ", ") + fixed(deg(value), 3);
  lines.emplace_back("gyro at its calmest", "(" + rates + ") +- " + fixed(deg(calmest.deviation), 3) +
                                                " degrees/s for a second: its bias, if it was at rest");
  return lines;
}

}  // namespace edgevo
