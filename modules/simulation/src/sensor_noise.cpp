// SPDX-License-Identifier: BSD-3-Clause
#include "sensor_noise.h"

#include <algorithm>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

constexpr uint64_t kNoisePurpose = 0x6e6f697365;
constexpr int kTable = 4096;

// Normal numbers to draw from: a draw is then a table look-up and costs a nanosecond.
std::vector<float> normal_table(double sigma) {
  Random random(kNoisePurpose);
  std::vector<float> table;
  for (int i = 0; i < kTable; ++i) table.push_back(float(sigma * random.normal()));
  return table;
}

}  // namespace

std::vector<uint8_t> with_sensor_noise(const std::vector<float>& gray, double sigma, uint64_t seed,
                                       int frame) {
  const std::vector<float> table = normal_table(sigma);
  Random random = Random::derive(seed ^ (uint64_t(frame) << 32), kNoisePurpose);
  std::vector<uint8_t> out(gray.size());
  uint64_t bits = 0;
  for (size_t i = 0; i < gray.size(); ++i) {
    if (i % 5 == 0) bits = random.next();  // five draws of twelve bits from each number
    const float noisy = gray[i] + table[bits % kTable];
    bits >>= 12;
    out[i] = uint8_t(std::clamp(noisy, 0.0f, 255.0f) + 0.5f);
  }
  return out;
}

}  // namespace edgevo
