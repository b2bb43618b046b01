#pragma once
// What one estimate says about one number of the camera, and whether it is believed.
#include "edgevo/core/records.h"

namespace edgevo {

struct Finding {
  double estimate = 0, sigma = 0;
  bool trustworthy = false;  ///< observed, and within the limit
  CameraRefinement::State state = CameraRefinement::State::kNotObservable;
};

/// What it takes to believe an estimate, and to go on believing it.
struct FindingCriteria {
  double max_useful_sigma = 0;    ///< known no better than this a number is not observed
  double limit = 0;               ///< of the number's size: the search is clamped there
  double significance = 0;        ///< standard deviations from the file's number that it takes to be applied
  double least_significance = 0;  ///< below these what is applied is given up
};

/// Standard deviations with what biased matches add to the `formal` one of an adjustment of `keyframes`:
/// their error of k1 falls with the number of keyframes, that of the read-out time, which needs fewer, with
/// its root.
double k1_sigma(double formal, int keyframes);
double readout_sigma(double formal, int keyframes);  ///< seconds

/// Four states of knowledge besides "too early": not observed, insignificant, at the limit, applied. What is
/// applied stays so until an estimate that can be trusted tells it apart from the file's number by less than
/// `least_significance`: it does not come and go. `before`: the state so far; `sigma` > 0.
Finding weigh(CameraRefinement::State before, double estimate, double by_file, double sigma,
              const FindingCriteria& criteria);

}  // namespace edgevo
