// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/self_calibration/lens_estimate.h"

#include "camera_problem.h"
#include "history.h"

namespace edgevo {
namespace {

constexpr double kNoBound = 1e9;  // of a prior on what is held: never used

CameraSearch search_of(const LensPrior& prior) {
  CameraSearch s;
  s.limit[kK1] = kMaxK2;
  s.prior_sigma = of_each(prior.k1, kNoBound, prior.k2, prior.focal, prior.centre);
  s.free = s.prior_sigma.array() > 0;
  s.free[kReadout] = false;
  s.prior_sigma = s.free.select(s.prior_sigma, ba::Unknowns::Constant(kNoBound));
  return s;
}

}  // namespace

LensEstimate estimate_lens(const Rectification& rectification, const Map& map, const LensPrior& prior,
                           const BaOptions& options) {
  LensEstimate lens;
  const CalibrationHistory history = make_history(rectification, {}, all_keyframes(map));
  if (history.problem.file.observations.empty()) return lens;
  const CameraSearch search = search_of(prior);
  const CameraEstimate e = estimate_camera(history.problem, search, options);
  if (!e.usable) return lens;
  lens.usable = true;
  lens.focal = e.value.correction.focal;
  lens.k1 = e.value.correction.k1, lens.k2 = e.value.k2;
  lens.centre = e.value.centre;
  const ba::Unknowns sigma = search.free.select(e.sigma, ba::Unknowns::Zero());
  lens.focal_sigma = sigma[kFocal], lens.k1_sigma = sigma[kK1], lens.k2_sigma = sigma[kK2];
  lens.centre_sigma = {sigma[kCentreX], sigma[kCentreY]};
  lens.keyframes = int(history.problem.file.poses.size());
  lens.observations = int(history.problem.file.observations.size());
  lens.cost = e.cost / lens.observations;
  return lens;
}

}  // namespace edgevo
