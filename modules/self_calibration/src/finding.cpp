#include "finding.h"

#include <cmath>

namespace edgevo {
namespace {

// Keyframes that the parameters' model sigmas refer to: a definition.
constexpr double kModelKeyframes = 30;
// Share of a limit beyond which an estimate stands at it: the search is clamped there, rounding aside.
constexpr double kAtLimit = 0.999;

}  // namespace

double k1_sigma(double formal, const SelfCalibrationParams& params, int keyframes) {
  return std::hypot(formal, params.model_sigma * kModelKeyframes / double(keyframes));
}

double readout_sigma(double formal, const SelfCalibrationParams& params, int keyframes) {
  return std::hypot(formal, params.readout_model_sigma * std::sqrt(kModelKeyframes / double(keyframes)));
}

Finding weigh(CameraRefinement::State before, double estimate, double by_file, double sigma,
              const FindingCriteria& criteria) {
  using State = CameraRefinement::State;
  const bool observed = sigma < criteria.max_useful_sigma;
  Finding f{estimate, sigma, observed && std::abs(estimate) < kAtLimit * criteria.limit, before};
  const double told_apart = std::abs(estimate - by_file) / sigma;
  const bool holds = !f.trustworthy || told_apart >= criteria.least_significance;
  if (before == State::kApplied && holds) return f;
  f.state = f.trustworthy && told_apart >= criteria.significance ? State::kApplied
            : observed && !f.trustworthy                         ? State::kAtLimit
            : observed                                           ? State::kInsignificant
                                                                 : State::kNotObservable;
  return f;
}

}  // namespace edgevo
