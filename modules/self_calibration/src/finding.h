// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What one estimate shows about one number of the camera, and whether it is trusted.
#include "edgevo/core/records.h"

namespace edgevo {

/// Weighed estimate of one number of the camera.
struct Finding {
  double estimate = 0, sigma = 0;
  /// True if the number is observable and within its limit.
  bool trustworthy = false;
  CameraRefinement::State state = CameraRefinement::State::kNotObservable;
};

/// Conditions to trust an estimate, and to keep trusting it.
struct FindingCriteria {
  /// Standard deviation above which a number counts as not observable.
  double max_useful_sigma = 0;
  /// Limit of the number's absolute value: the search is clamped there.
  double limit = 0;
  /// Standard deviations from the file's number from which an estimate is applied.
  double significance = 0;
  /// Standard deviations below which an applied estimate is given up.
  double least_significance = 0;
};

/// Standard deviation of k1: the formal one of an adjustment of `keyframes`, plus the effect of biased
/// matches, which falls with the number of keyframes.
double k1_sigma(double formal, int keyframes);
/// Standard deviation of the read-out time in seconds: the formal one, plus the effect of biased matches,
/// which falls with the root of the number of keyframes.
double readout_sigma(double formal, int keyframes);

/// Classifies an estimate in four states besides "too early": not observable, insignificant, at the limit,
/// applied. An applied value stays applied until a trustworthy estimate differs from the file's number by
/// less than `least_significance`, so that it does not alternate. `before`: the state so far; `sigma` > 0.
Finding weigh(CameraRefinement::State before, double estimate, double by_file, double sigma,
              const FindingCriteria& criteria);

}  // namespace edgevo
