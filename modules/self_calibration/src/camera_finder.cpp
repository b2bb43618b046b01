// SPDX-License-Identifier: BSD-3-Clause
#include "camera_finder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edgevo/self_calibration/lens_estimate.h"
#include "finding.h"
#include "focal_length.h"
#include "held_back.h"

namespace edgevo {
namespace {

using State = CameraRefinement::State;

// A k1 with a larger standard deviation is not observable: 1.2 px at the border of a wide image, more than
// the tolerance of a match.
constexpr double kMaxUsefulSigma = 0.004;
// Seconds: a read-out time with a larger one is not observable, a quarter of the 20 ms of a webcam.
constexpr double kMaxUsefulReadoutSigma = 0.005;
// Standard deviations below which an applied read-out time or focal length is given up: found early in bad
// light, it may turn out to be zero. Half of the threshold for applying one, so that it does not alternate.
constexpr double kMinSignificance = 1.5;
// Factor on an estimated change of the read-out time. Matches found in images with rolling-shutter distortion
// bias the estimates: they come out a fifth to a half short and approach the truth step by step
// (lab 2026-11-22_rolling_shutter).
constexpr double kOverRelaxation = 1.3;

class CameraFinder {
 public:
  CameraFinder(CameraProblem problem, const CameraRefinement& known, const SelfCalibrationParams& params,
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
    // Corners know it whatever the map, also a later, shorter one.
    if (do_corners_contradict(known_)) {
      weigh_focal_length();
      return {state_, moved_only_by_focal_length(), true};
    }
    if (knew_more()) return nothing();
    if (!problem_.is_in_doubt) weigh_focal_length();
    const bool estimate_k1 = params_.refines_k1() && keyframes_ >= params_.min_keyframes;
    const bool estimate_readout =
        params_.refines_readout() && (state_.shutter.state == State::kApplied || !estimate_k1);
    if (!estimate_k1 && !estimate_readout) return nothing();
    CameraEstimate e = search(estimate_k1, estimate_readout);
    if (!e.usable) return nothing();
    if (params_.refines_readout() && !estimate_readout) e = look_at_shutter(std::move(e));
    return apply_significant(std::move(e));
  }

 private:
  // Nothing but perhaps a focal length.
  CameraDecision nothing() const { return {state_, moved_only_by_focal_length(), false}; }

  std::optional<CameraEstimate> moved_only_by_focal_length() const {
    if (state_.correction == known_.correction) return std::nullopt;
    CameraEstimate e = search(false, false);
    return e.usable ? std::make_optional(std::move(e)) : std::nullopt;
  }

  // The posterior of the whole camera, and by it a focal length in place of the one in use: its mean where
  // the file's is improbable, else the file's; both only if the map and what was held back of it support it.
  void weigh_focal_length() {
    if (!params_.refines_k1() && !params_.refines_focal_length()) return;
    const double in_use = known_.correction.focal;
    const CameraSearch s = search_for_camera(known_, params_.refines_readout(), params_.readout_s);
    state_.focal_length.windows_rejected = state_.focal_length.windows;
    const CameraProblem start = seen_with_focal_length(problem_, in_use, s.start.correction.focal);
    const CameraEstimate e = estimate_camera(start, s, options_);
    if (!e.usable || is_at_limit(e.value.correction.focal)) return;
    const FocalPosterior posterior = focal_posterior(known_, e);
    const double significance = in_use == 0 ? params_.significance : kMinSignificance;
    const bool is_improbable = std::abs(posterior.mean) > significance * posterior.sigma_in_use;
    const bool is_to_change = is_improbable || in_use != 0;
    if (is_improbable && !posterior.do_matches_agree) return;
    if (is_to_change && !is_better(start, e)) return;
    note_lens(e, posterior);
    if (!is_to_change || !params_.refines_focal_length() || !problem_.rectification.camera().plumb_bob())
      return;
    state_.correction.focal = is_improbable ? posterior.mean : 0;
    state_.focal_length.state = is_improbable ? State::kApplied : State::kInsignificant;
    problem_ = seen_with_focal_length(started_at(start, e.solution), e.value.correction.focal,
                                      state_.correction.focal);
  }

  // A later, shorter segment knows less.
  bool knew_more() const {
    return (state_.state == State::kApplied && keyframes_ < state_.keyframes) ||
           (state_.shutter.state == State::kApplied && keyframes_ < state_.shutter.keyframes);
  }

  // Where the motion shows nothing of the camera, the steps of a search lead uphill.
  bool is_better(const CameraProblem& start, const CameraEstimate& e) const {
    const CameraEstimate in_use = search(false, false);
    return in_use.usable && e.cost < in_use.cost &&
           compare_on_held_back(start, e, known_.correction, options_).allows_estimate();
  }

  CameraEstimate search(bool free_k1, bool free_readout) const {
    CameraSearch s;
    s.start = state_.correction;
    s.free[kK1] = free_k1, s.free[kReadout] = free_readout;
    s.prior[kReadout] = params_.readout_s;
    return estimate_camera(problem_, s, options_);
  }

  // Looks for a rolling shutter after k1 was estimated alone, by the read-out time that one more step yields.
  // Such a step is less reliable than a search, and far from the minimum its own standard deviation means
  // little; if it is large, a search for both decides.
  CameraEstimate look_at_shutter(CameraEstimate k1_alone) {
    const double one_step = k1_alone.if_all_free[kReadout], doubt = readout_sigma(0, keyframes_);
    if (std::abs(one_step - params_.readout_s) < 0.5 * params_.significance * doubt) {
      note_readout(one_step, k1_alone.sigma[kReadout]);
      return k1_alone;
    }
    CameraEstimate both = search(true, true);
    if (!both.usable) return k1_alone;
    note_readout(both.value.correction.readout_s, both.sigma[kReadout]);
    return state_.shutter.state == State::kApplied ? std::move(both) : std::move(k1_alone);
  }

  Finding note_k1(double k1, double formal_sigma) {
    const FindingCriteria criteria{kMaxUsefulSigma, kMaxK1, params_.significance, 0};
    const Finding f = weigh(state_.state, k1, 0, k1_sigma(formal_sigma, keyframes_), criteria);
    state_.state = f.state;
    state_.estimate = f.estimate, state_.sigma = f.sigma, state_.keyframes = keyframes_;
    return f;
  }

  void note_lens(const CameraEstimate& e, const FocalPosterior& focal) {
    const ba::Unknowns sigma = kSigmasOfMatches * e.sigma;
    state_.lens = {e.value.correction.k1, e.value.k2, focal.mean, sigma[kK1], sigma[kK2],
                   focal.sigma,           keyframes_};
  }

  Finding note_readout(double readout_s, double formal_sigma) {
    CameraRefinement::Shutter& s = state_.shutter;
    const FindingCriteria criteria{kMaxUsefulReadoutSigma, kMaxReadout, params_.significance,
                                   kMinSignificance};
    const Finding f =
        weigh(s.state, readout_s, params_.readout_s, readout_sigma(formal_sigma, keyframes_), criteria);
    s.state = f.state;
    s.estimate = f.estimate, s.sigma = f.sigma, s.keyframes = keyframes_;
    return f;
  }

  // Decides what of an estimate is applied. Insignificant values are reset, and the rest is estimated again.
  CameraDecision apply_significant(CameraEstimate e) {
    const bool k1_free = e.free[kK1], readout_free = e.free[kReadout];
    bool k1 = false, readout = false, given_up = false;
    if (readout_free) {
      const Finding f = note_readout(e.value.correction.readout_s, e.sigma[kReadout]);
      readout = f.state == State::kApplied;
      given_up = known_.shutter.state == State::kApplied && !readout;
      if (readout && !f.trustworthy) return nothing();
    }
    if (k1_free) {
      const Finding f = note_k1(e.value.correction.k1, e.sigma[kK1]);
      k1 = f.state == State::kApplied;
      if (k1 && !f.trustworthy) return nothing();
    }
    if (!k1 && !readout && !given_up) return nothing();
    if (readout) state_.correction.readout_s = over_relaxed(e.value.correction.readout_s);
    if (given_up) state_.correction.readout_s = params_.readout_s;
    if (readout || given_up || k1 != k1_free) e = search(k1, false);
    if (!e.usable) return {known_, std::nullopt, false};
    if (given_up && !k1) return {state_, std::move(e), false};
    if (!compare_on_held_back(problem_, e, by_file(), options_).allows_estimate()) return back_to_file();
    if (k1) state_.estimate = state_.correction.k1 = e.value.correction.k1;
    return {state_, std::move(e), false};
  }

  // But for the focal length, which was weighed before.
  ImageCorrection by_file() const { return {0, params_.readout_s, state_.correction.focal}; }

  // What the estimate was not made of supports the camera file. Moves the map only if it was corrected
  // before.
  CameraDecision back_to_file() {
    for (State* state : {&state_.state, &state_.shutter.state})
      if (*state == State::kApplied) *state = State::kInsignificant;
    state_.correction = by_file();
    if (known_.correction == state_.correction) return nothing();
    CameraEstimate e = search(false, false);
    if (!e.usable) return {known_, std::nullopt, false};
    return {state_, std::move(e), false};
  }

  double over_relaxed(double readout_s) const {
    const double before = state_.correction.readout_s;
    const double factor = params_.over_relax_readout ? kOverRelaxation : 1;
    return std::clamp(before + factor * (readout_s - before), -kMaxReadout, kMaxReadout);
  }

  CameraProblem problem_;
  const SelfCalibrationParams& params_;
  BaOptions options_;
  int keyframes_;
  CameraRefinement known_, state_;
};

}  // namespace

CameraDecision find_camera(const CameraProblem& problem, const CameraRefinement& known,
                           const SelfCalibrationParams& params, const BaOptions& options) {
  return CameraFinder(problem, known, params, options).run();
}

}  // namespace edgevo
