// SPDX-License-Identifier: BSD-3-Clause
#include "camera_finder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "edgevo/self_calibration/lens_estimate.h"
#include "focal_length.h"
#include "held_back.h"

namespace edgevo {
namespace {

// Share of the significance below which what is applied is given up, so that it does not alternate.
constexpr double kGivenUp = 0.5;

// As numbers of a posterior.
constexpr std::array<CameraUnknown, kCameraNumbers> kUnknownOf{kK1, kReadout, kK2, kFocal};

// Seconds: standard deviation of the read-out time that all matches of a keyframe share. kSigmasOfMatches is
// no substitute: where rows are not straight yet, clusters scatter by themselves, and the time that
// straightens them would be insignificant.
constexpr double kSharedReadout = 0.008;

CameraGaussian gaussian_of(const CameraEstimate& e, int keyframes) {
  CameraGaussian g;
  const auto factor = [](CameraUnknown u) { return u == kReadout ? 1 : kSigmasOfMatches; };
  for (int i = 0; i < kCameraNumbers; ++i) {
    const CameraUnknown a = kUnknownOf[i];
    g.mean[i] = e.value.unknowns()[a];
    for (int j = 0; j < kCameraNumbers; ++j)
      g.covariance(i, j) = factor(a) * factor(kUnknownOf[j]) * e.covariance(a, kUnknownOf[j]);
  }
  if (e.free[kReadout]) {
    constexpr int kR = int(CameraNumber::kReadout);
    g.covariance(kR, kR) += kSharedReadout * kSharedReadout / keyframes;
  }
  g.keyframes = keyframes;
  return g;
}

class CameraFinder {
 public:
  CameraFinder(CameraProblem problem, const CameraPosterior& known, const SelfCalibrationParams& params,
               const BaOptions& options)
      : problem_(std::move(problem)),
        params_(params),
        options_(options),
        keyframes_(int(problem_.file.poses.size())),
        known_(known),
        state_(known) {
    // A first solve that starts far off took 9 to 15 at a tolerance of 1e-6.
    options_.max_iterations = 15;
    // Relative to a cost of thousands: less than the effect of a standard deviation of k1.
    options_.relative_decrease = 1e-5;
    // The trajectory has been adjusted before: saves an iteration or more at 120 keyframes.
    options_.initial_damping = 1e-6;
  }

  CameraDecision run() {
    const bool is_lens_sought = params_.refines_k1() || params_.refines_focal_length();
    if (is_lens_sought && (!problem_.is_in_doubt || do_corners_contradict(known_))) weigh_focal_length();
    if (!knew_more()) weigh_the_rest();
    if (state_.applied == known_.applied) return {state_, std::nullopt};
    CameraEstimate e = search(only({}), state_.applied);
    if (!e.usable) return {known_, std::nullopt};
    return {state_, std::move(e)};
  }

 private:
  // Whether a number is not that of the file.
  bool is_wrong(double difference, double sigma, bool is_applied) const {
    return std::abs(difference) > (is_applied ? kGivenUp : 1) * params_.significance * sigma;
  }

  // By the posterior of the whole camera, a focal length in place of the one in use: its mean where the
  // file's is improbable, else the file's; both only if the map and what was held back of it support it.
  void weigh_focal_length() {
    const double in_use = known_.applied.focal;
    const CameraSearch s = search_for_camera(known_, params_.refines_readout(), params_.readout_s);
    state_.corners.windows_weighed = state_.corners.windows;
    const CameraProblem start = seen_with_focal_length(problem_, in_use, s.start.correction.focal);
    const CameraEstimate e = estimate_camera(start, s, options_);
    if (!e.usable || is_at_limit(e.value.correction.focal)) return;
    const FocalPosterior posterior = focal_posterior(known_, e);
    const bool is_improbable = is_wrong(posterior.mean, posterior.sigma_in_use, in_use != 0);
    const bool is_to_change = is_improbable || in_use != 0;
    if (is_improbable && !posterior.do_matches_agree) return;
    if (is_to_change && !is_better(start, e)) return;
    state_.whole = gaussian_of(e, keyframes_);
    state_.whole.set(CameraNumber::kFocal, posterior.mean, posterior.sigma_in_use);
    if (!is_to_change || !state_.is_sought[size_t(CameraNumber::kFocal)]) return;
    state_.applied.focal = is_improbable ? posterior.mean : 0;
    problem_ =
        seen_with_focal_length(started_at(start, e.solution), e.value.correction.focal, state_.applied.focal);
  }

  // Where the motion shows nothing of the camera, the steps of a search lead uphill.
  bool is_better(const CameraProblem& start, const CameraEstimate& e) const {
    const CameraEstimate in_use = search(only({}), known_.applied);
    return in_use.usable && e.cost < in_use.cost &&
           compare_on_held_back(start, e, known_.applied, options_).allows_estimate();
  }

  // A later, shorter segment knows less.
  bool knew_more() const { return known_.applied != by_file() && keyframes_ < known_.given.keyframes; }

  // k1 and the read-out time with the focal length given: what is not improbable is the file's, the least
  // significant first, and the rest is searched again.
  void weigh_the_rest() {
    CameraMask free = only({});
    free[kK1] = params_.refines_k1(), free[kReadout] = params_.refines_readout();
    CameraError value = state_.applied;
    while (free.any()) {
      const CameraEstimate e = search(free, value.correction);
      if (!e.usable) return;
      note(e);
      const std::optional<CameraUnknown> rejected = least_significant(e);
      if (!rejected) {
        if (compare_on_held_back(problem_, e, by_file(), options_).allows_estimate()) return apply(e);
        break;
      }
      ba::Unknowns next = e.value.unknowns();
      next[*rejected] = CameraError(by_file()).unknowns()[*rejected];
      value = CameraError(next);
      free[*rejected] = false;
      problem_ = started_at(problem_, e.solution);
    }
    state_.applied = by_file();
  }

  // Of the free numbers that the file may have right, or that are not known, the least significant one.
  std::optional<CameraUnknown> least_significant(const CameraEstimate& e) const {
    const ba::Unknowns file = CameraError(by_file()).unknowns(),
                       in_use = CameraError(known_.applied).unknowns();
    std::optional<CameraUnknown> least;
    double least_sigmas = 0;
    for (const CameraNumber n : {CameraNumber::kK1, CameraNumber::kReadout}) {
      const CameraUnknown u = kUnknownOf[size_t(n)];
      if (!e.free[u]) continue;
      const double difference = state_.given.mean_of(n) - file[u], sigma = state_.given.sigma_of(n);
      if (is_wrong(difference, sigma, in_use[u] != file[u]) && !state_.is_at_limit(n)) continue;
      const double sigmas = std::abs(difference) / sigma;
      if (!least || sigmas < least_sigmas) least = u, least_sigmas = sigmas;
    }
    return least;
  }

  void note(const CameraEstimate& e) {
    const CameraGaussian found = gaussian_of(e, keyframes_);
    for (int i = 0; i < kCameraNumbers; ++i)
      if (e.free[kUnknownOf[i]])
        state_.given.set(CameraNumber(i), found.mean[i], std::sqrt(found.covariance(i, i)));
    state_.given.keyframes = keyframes_;
  }

  void apply(const CameraEstimate& e) {
    state_.applied = e.value.correction;
    if (!e.free[kReadout] || !params_.over_relax_readout) return;
    const double before = known_.applied.readout_s;
    const double relaxed = before + (1 + kMissedByMatches) * (e.value.correction.readout_s - before);
    state_.applied.readout_s = std::clamp(relaxed, -kMaxReadout, kMaxReadout);
  }

  CameraEstimate search(const CameraMask& free, const ImageCorrection& start) const {
    CameraSearch s;
    s.start = start;
    s.free = free;
    s.prior[kReadout] = params_.readout_s;
    return estimate_camera(problem_, s, options_);
  }

  // But for the focal length, which is weighed before.
  ImageCorrection by_file() const { return {0, params_.readout_s, state_.applied.focal}; }

  CameraProblem problem_;
  const SelfCalibrationParams& params_;
  BaOptions options_;
  int keyframes_;
  CameraPosterior known_, state_;
};

}  // namespace

CameraDecision find_camera(const CameraProblem& problem, const CameraPosterior& known,
                           const SelfCalibrationParams& params, const BaOptions& options) {
  return CameraFinder(problem, known, params, options).run();
}

}  // namespace edgevo
