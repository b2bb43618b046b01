// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Sensor noise, and rounding to 8 bits.
#include <cstdint>
#include <vector>

namespace edgevo {

/// Rounded and clamped gray plus normal noise of `sigma` gray levels. The noise depends on (seed, frame)
/// only.
std::vector<uint8_t> with_sensor_noise(const std::vector<float>& gray, double sigma, uint64_t seed,
                                       int frame);

}  // namespace edgevo
