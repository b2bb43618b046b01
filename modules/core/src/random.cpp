// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/random.h"

#include <cmath>

namespace edgevo {

double Random::normal() {
  const double u = 1.0 - uniform();  // (0, 1], so that the logarithm is finite
  return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * M_PI * uniform());
}

}  // namespace edgevo
