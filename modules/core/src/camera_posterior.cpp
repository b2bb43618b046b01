// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "edgevo/core/records.h"

namespace edgevo {

void CameraGaussian::set(CameraNumber n, double value, double sigma) {
  mean[int(n)] = value;
  covariance.row(int(n)).setZero(), covariance.col(int(n)).setZero();
  covariance(int(n), int(n)) = sigma * sigma;
}

CameraPosterior::State CameraPosterior::state_of(CameraNumber n) const {
  const bool is_focal = n == CameraNumber::kFocal;
  const CameraGaussian& known = is_focal ? whole : given;
  const double correction = is_focal                 ? applied.focal
                            : n == CameraNumber::kK1 ? applied.k1
                                                     : applied.readout_s - readout_given_s;
  const double largest = kLargestCameraError[size_t(n)];
  if (!is_sought[size_t(n)]) return State::kOff;
  if (correction != 0) return State::kApplied;
  if (is_focal && corners.windows > 0) return State::kInsignificant;
  if (known.sigma_of(n) == 0) return State::kTooEarly;
  if (kImprobable * known.sigma_of(n) > largest) return State::kNotObservable;
  return is_at_limit(n) ? State::kAtLimit : State::kInsignificant;
}

bool CameraPosterior::is_at_limit(CameraNumber n) const {
  return given.sigma_of(n) > 0 && std::abs(given.mean_of(n)) >= kLargestCameraError[size_t(n)];
}

double CameraPosterior::focal_sigma() const {
  return std::hypot(whole.sigma_of(CameraNumber::kFocal),
                    kMissedByMatches * (whole.mean_of(CameraNumber::kFocal) - applied.focal));
}

bool CameraPosterior::contradicts_focal_length() const {
  const double sigma = whole.sigma_of(CameraNumber::kFocal);
  return sigma > 0 && std::abs(whole.mean_of(CameraNumber::kFocal) - applied.focal) > kImprobable * sigma;
}

const std::vector<std::string>& camera_state_names() {
  static const std::vector<std::string> names{"off",           "too_early", "not_observable",
                                              "insignificant", "applied",   "at_limit"};
  return names;
}

}  // namespace edgevo
