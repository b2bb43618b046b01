// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A smooth random function of time.
#include <cmath>
#include <vector>

#include "edgevo/core/random.h"

namespace edgevo {

/// Sum of a few sines of random phase and frequencies around `hz`; mean 0, standard deviation about 1,
/// infinitely differentiable.
class SmoothNoise {
 public:
  SmoothNoise(Random* random, double hz) {
    for (int i = 0; i < kTerms; ++i)
      terms_.push_back(
          {6.283185307179586 * hz * random->uniform(0.35, 1.5), random->uniform(0, 6.283185307179586)});
  }
  double operator()(double t) const {
    double sum = 0;
    for (const Term& term : terms_) sum += std::sin(term.omega * t + term.phase);
    return sum * std::sqrt(2.0 / kTerms);
  }

 private:
  static constexpr int kTerms = 5;
  struct Term {
    double omega, phase;
  };
  std::vector<Term> terms_;
};

}  // namespace edgevo
