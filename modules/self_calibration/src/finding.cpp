// SPDX-License-Identifier: BSD-3-Clause
#include "finding.h"

#include <cmath>

namespace edgevo {
namespace {

// Standard deviations that biased matches add to k1 and to the read-out time (seconds), at kModelKeyframes.
constexpr double kModelSigma = 0.004, kReadoutModelSigma = 0.0015;
constexpr double kModelKeyframes = 30;
// Share of a limit beyond which an estimate counts as clamped, since rounding may differ.
constexpr double kAtLimit = 0.999;

}  // namespace

double k1_sigma(double formal, int keyframes) {
  return std::hypot(formal, kModelSigma * kModelKeyframes / double(keyframes));
}

double readout_sigma(double formal, int keyframes) {
  return std::hypot(formal, kReadoutModelSigma * std::sqrt(kModelKeyframes / double(keyframes)));
}

Finding weigh(CameraRefinement::State before, double estimate, double by_file, double sigma,
              const FindingCriteria& criteria) {
  using State = CameraRefinement::State;
  const bool observed = sigma < criteria.max_useful_sigma;
  Finding f{estimate, sigma, observed && std::abs(estimate) < kAtLimit * criteria.limit, before};
  const double sigmas_apart = std::abs(estimate - by_file) / sigma;
  const bool holds = !f.trustworthy || sigmas_apart >= criteria.least_significance;
  if (before == State::kApplied && holds) return f;
  f.state = f.trustworthy && sigmas_apart >= criteria.significance ? State::kApplied
            : observed && !f.trustworthy                           ? State::kAtLimit
            : observed                                             ? State::kInsignificant
                                                                   : State::kNotObservable;
  return f;
}

}  // namespace edgevo
