#include "edgevo/mapping/self_calibration.h"

#include <Eigen/LU>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>

#include "edgevo/core/radial.h"
#include "map_revision.h"

namespace edgevo {
namespace {

using ba::RadialEstimate;
using ba::RadialProblem;

constexpr double kMaxUsefulSigma = 0.004;  // a k1 known no better than this is not observed
constexpr double kModelKeyframes = 30;     // that SelfCalibrationParams::model_sigma refers to
constexpr double kMinChange = 5e-4;        // of k1; smaller corrections wait for the end of the run

RadialEstimate estimate_from(const RadialProblem& problem, double k1, const SelfCalibrationParams& params, BaOptions options) {
  options.max_iterations = 15;
  options.relative_decrease = 1e-5;  // of a cost of thousands: less than a standard deviation of k1 is worth
  options.initial_damping = 1e-6;    // the way has been adjusted before: an iteration or more fewer at 120 keyframes
  return ba::estimate_k1(problem, k1, params.prior_sigma, params.max_k1, options);
}

}  // namespace

// An estimate in a thread of its own, on what was known when it began.
struct SelfCalibration::Job {
  CalibrationHistory history;
  std::future<RadialEstimate> estimate;  // last: it waits for its thread before the history goes
};

Eigen::Vector2d correct_pixel(const Pinhole& c, double k1_before, double k1, const Eigen::Vector2d& px) {
  const Eigen::Vector2d x = remove_radial(k1, add_radial(k1_before, c.ray(px).head<2>()));
  return {c.fx * x.x() + c.cx, c.fy * x.y() + c.cy};
}

// A gradient is a covector: n' ~ (d px / d px')^T n.
Eigen::Vector2d correct_normal(const Pinhole& c, double k1_before, double k1, const Eigen::Vector2d& px,
                               const Eigen::Vector2d& normal) {
  const Eigen::Vector2d x = c.ray(px).head<2>();
  const Eigen::Vector2d corrected = remove_radial(k1, add_radial(k1_before, x));
  const Eigen::Matrix2d J = radial_jacobian(k1_before, x).inverse() * radial_jacobian(k1, corrected);
  const Eigen::Vector2d f(c.fx, c.fy);
  return f.cwiseInverse().cwiseProduct(J.transpose() * f.cwiseProduct(normal)).normalized();
}

void SelfCalibrationParams::visit(ParamVisitor& v) {
  v.text("refine", refine, {"none", "k1"}, "residual radial distortion found while running; none: the file is taken as it is");
  v.integer("min_keyframes", min_keyframes, 10, 200, "at the first estimate; each further one at twice as many");
  v.integer("checkpoints", checkpoints, 1, 5, "estimates while running; the last one takes about a second (realtime: in a thread beside)");
  v.number("prior_sigma", prior_sigma, 1e-4, 1, "standard deviation of k1 before anything was seen");
  v.number("max_k1", max_k1, 1e-4, 0.2, "an estimate at this limit is not applied");
  v.number("significance", significance, 0, 100, "standard deviations from zero that an estimate needs to be applied");
  v.number("model_sigma", model_sigma, 0, 0.1, "error of k1 by biased matches after 30 keyframes; falls as their number grows");
}

SelfCalibration::SelfCalibration(const Pinhole& pinhole, const SelfCalibrationParams& params)
    : pinhole_(pinhole), params_(params), next_checkpoint_(params.min_keyframes) {
  if (params.refine != "none") state_.state = CameraRefinement::State::kTooEarly;
}

SelfCalibration::SelfCalibration(SelfCalibration&&) noexcept = default;
SelfCalibration& SelfCalibration::operator=(SelfCalibration&&) noexcept = default;
SelfCalibration::~SelfCalibration() = default;

void SelfCalibration::remember(const Keyframe& keyframe) {
  if (finished_ || params_.refine == "none") return;
  history_.push_back(keyframe);
  history_.back().pyramid.reset();
  history_.back().immature.clear();
}

bool SelfCalibration::is_due(int window_keyframes) const {
  return !job_ && !finished_ && params_.refine != "none" && int(history_.size()) + window_keyframes >= next_checkpoint_;
}

void SelfCalibration::forget() {
  job_.reset();
  history_.clear();
}

// Three states of knowledge besides "too early": not observed, observed and insignificant, applied. What is applied stays applied.
bool SelfCalibration::judge(double k1, double sigma, int keyframes) {
  using State = CameraRefinement::State;
  if (state_.state == State::kApplied && keyframes < state_.keyframes) return false;  // a later, shorter segment knows less
  state_.estimate = k1;
  state_.sigma = std::hypot(sigma, params_.model_sigma * kModelKeyframes / double(keyframes));
  state_.keyframes = keyframes;
  const bool observed = state_.sigma < kMaxUsefulSigma, believable = std::abs(k1) < 0.999 * params_.max_k1;
  if (state_.state == State::kApplied) return observed && believable;
  const bool significant = observed && believable && std::abs(k1) >= params_.significance * state_.sigma;
  state_.state = significant ? State::kApplied : observed ? State::kInsignificant : State::kNotObservable;
  return significant;
}

// The next checkpoint; after the last one nothing is remembered any more.
void SelfCalibration::pass_checkpoint(int keyframes, bool at_end) {
  const int last = params_.min_keyframes << (params_.checkpoints - 1);
  while (keyframes >= next_checkpoint_ && next_checkpoint_ < last) next_checkpoint_ *= 2;
  if (keyframes < last || at_end) return;
  finished_ = true;
  history_.clear();
  history_.shrink_to_fit();
}

std::vector<const Keyframe*> SelfCalibration::all_keyframes(const std::vector<const Keyframe*>& window) const {
  std::vector<const Keyframe*> keyframes;
  for (const Keyframe& k : history_) keyframes.push_back(&k);
  keyframes.insert(keyframes.end(), window.begin(), window.end());
  return keyframes;
}

void SelfCalibration::begin(const std::vector<const Keyframe*>& window, const BaOptions& options) {
  job_ = std::make_unique<Job>();
  job_->history = make_history(pinhole_, state_.k1, all_keyframes(window));
  job_->estimate = std::async(std::launch::async, [&problem = job_->history.problem, k1 = state_.k1, params = params_, options] {
    return estimate_from(problem, k1, params, options);
  });
}

bool SelfCalibration::is_ready() const {
  return job_ && job_->estimate.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::optional<MapRevision> SelfCalibration::estimate(const std::vector<const Keyframe*>& window, const BaOptions& options, bool at_end) {
  if (finished_ || params_.refine == "none" || window.empty()) return std::nullopt;
  const std::vector<const Keyframe*> keyframes = all_keyframes(window);
  if (int(keyframes.size()) < params_.min_keyframes) return std::nullopt;
  const CalibrationHistory history = make_history(pinhole_, state_.k1, keyframes);
  int known = int(keyframes.size());
  RadialEstimate e;
  if (const std::unique_ptr<Job> job = std::move(job_)) {
    known = int(job->history.point_index.size());
    e = job->estimate.get();
    if (e.usable) e.solution = carry_over(job->history, e, history);
  } else {
    e = estimate_from(history.problem, state_.k1, params_, options);
  }
  std::optional<MapRevision> revision;
  if (e.usable && judge(e.k1, e.sigma, known) && (at_end || std::abs(e.k1 - state_.k1) > kMinChange)) {
    revision = make_revision(pinhole_, state_.k1, keyframes, history_.size(), history, options, &e);
    apply_to_history(pinhole_, *revision, &history_);
    state_.k1 = e.k1;
  }
  pass_checkpoint(known, at_end);
  return revision;
}

}  // namespace edgevo
