// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/self_calibration/self_calibration.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <optional>
#include <utility>

#include "camera_finder.h"
#include "edgevo/core/thread_priority.h"
#include "edgevo/core/trace.h"
#include "focal_length.h"
#include "history.h"
#include "map_move.h"

namespace edgevo {
namespace {

// Number of estimates during a run; the last one is the most expensive, about a second at 120 keyframes.
constexpr int kCheckpoints = 3;

// Each estimate improves the matches of the next one.
int first_checkpoint(const SelfCalibrationParams& p) { return std::max(1, p.min_keyframes / 3); }
int keyframes_of(const Map& map) { return int(map.marginalised().size() + map.active().size()); }
int checkpoint_after(int keyframes, const SelfCalibrationParams& p) {
  return keyframes < p.min_keyframes ? std::min(p.min_keyframes, keyframes + (keyframes + 1) / 2)
                                     : 2 * keyframes;
}

}  // namespace

// An estimate in a thread of its own, on a copy of the data at its beginning.
struct SelfCalibration::Job {
  int moves = 0;  // of the map at its beginning
  bool is_of_focal_length = false;
  CalibrationHistory history;
  std::optional<CameraDecision> found;
  std::future<CameraDecision>
      finding;  // last member: it waits for its thread before the history is destroyed
};

void SelfCalibrationParams::visit(ParamVisitor& v) {
  v.text(
      kBasic, "refine", refine, {"none", "k1", "readout", "focal", "all"},
      "what is estimated during a run: residual radial distortion, read-out time of a rolling shutter, focal "
      "length; none: use the camera file as it is");
  v.integer(
      kAdvanced, "min_keyframes", min_keyframes, 10, 200,
      "keyframes, a third of which are needed for the first estimate; from there on, twice as many at each "
      "further one");
  v.number(kAdvanced, "significance", significance, 0, 100,
           "standard deviations from zero from which an estimate is applied");
  v.number(kBasic, "readout_s", readout_s, -0.2, 0.2,
           "read-out time of a rolling shutter, seconds from the first row to the last; 0: global shutter or "
           "unknown");
  v.boolean(kExperimental, "over_relax_readout", over_relax_readout,
            "apply half more than the estimated change of the read-out time: estimates come out too small");
}

SelfCalibration::SelfCalibration(const Rectification& rectification, const SelfCalibrationParams& params)
    : rectification_(rectification), params_(params), next_checkpoint_(first_checkpoint(params)) {
  state_.is_sought[size_t(CameraNumber::kK1)] = params.refines_k1();
  state_.is_sought[size_t(CameraNumber::kReadout)] = params.refines_readout();
  // Of another lens the focal length is no scale of its image.
  state_.is_sought[size_t(CameraNumber::kFocal)] =
      params.refines_focal_length() && rectification.camera().plumb_bob();
  state_.applied.readout_s = state_.readout_given_s = params.readout_s;
}

SelfCalibration::SelfCalibration(SelfCalibration&&) noexcept = default;
SelfCalibration& SelfCalibration::operator=(SelfCalibration&&) noexcept = default;
SelfCalibration::~SelfCalibration() = default;

void SelfCalibration::begin_with(const CameraPosterior& found) {
  state_.given = found.given;
  state_.applied.readout_s = found.applied.readout_s;
}

void SelfCalibration::note_focal_length(const FocalError& by_corners) {
  if (!state_.is_sought[size_t(CameraNumber::kFocal)]) return;
  CameraPosterior::Corners& found = state_.corners;
  found.focal = by_corners.value, found.sigma = by_corners.sigma, found.windows = by_corners.windows;
}

bool SelfCalibration::is_focal_length_due(const Map& map) const {
  if (job_) return job_->is_of_focal_length;
  return needs_matches() && keyframes_of(map) >= first_checkpoint(params_) && do_corners_contradict(state_);
}

bool SelfCalibration::is_due(const Map& map) const {
  return !job_ && needs_matches() && (keyframes_of(map) >= next_checkpoint_ || is_focal_length_due(map));
}

void SelfCalibration::cancel() { job_.reset(); }

// Advances to the next checkpoint; after the last one no matches are needed any more.
void SelfCalibration::pass_checkpoint(int keyframes, bool at_end) {
  const int last = params_.min_keyframes << (kCheckpoints - 1);
  while (keyframes >= next_checkpoint_ && next_checkpoint_ < last)
    next_checkpoint_ = checkpoint_after(next_checkpoint_, params_);
  if (keyframes >= last && !at_end) finished_ = true;
}

void SelfCalibration::begin(const Map& map, const BaOptions& options) {
  job_ = std::make_unique<Job>();
  job_->moves = map.moves();
  job_->is_of_focal_length = do_corners_contradict(state_);
  job_->history = make_history(rectification_, state_.applied, all_keyframes(map));
  job_->finding = std::async(std::launch::async,
                             [&problem = job_->history.problem, known = state_, params = params_, options] {
                               name_traced_thread("self-calibration");
                               lower_thread_priority();
                               const TraceScope traced("estimate of the camera");
                               return find_camera(problem, known, params, options);
                             });
}

bool SelfCalibration::is_ready() const {
  return job_ &&
         (job_->found || job_->finding.wait_for(std::chrono::seconds(0)) == std::future_status::ready);
}

std::optional<ImageCorrection> SelfCalibration::correction_found() {
  if (!is_ready()) return std::nullopt;
  if (!job_->found) job_->found = job_->finding.get();
  return job_->found->estimate ? std::make_optional(job_->found->estimate->value.correction) : std::nullopt;
}

std::optional<MapMoved> SelfCalibration::estimate(const Map& map, const BaOptions& options, bool at_end) {
  if (!needs_matches() || map.active().empty()) return std::nullopt;
  const std::vector<const Keyframe*> keyframes = all_keyframes(map);
  if (!job_ && int(keyframes.size()) < first_checkpoint(params_)) return std::nullopt;
  const CalibrationHistory history = make_history(rectification_, state_.applied, keyframes);
  int known = int(keyframes.size());
  CameraDecision found;
  std::unique_ptr<Job> job = std::move(job_);
  if (job && job->moves != map.moves()) {
    // Others have moved the map meanwhile: the estimate would move it back.
    if (!at_end) return std::nullopt;
    job.reset();
  }
  if (job) {
    known = int(job->history.point_index.size());
    found = job->found ? std::move(*job->found) : job->finding.get();
    if (found.estimate) found.estimate->solution = carry_over(job->history, *found.estimate, history);
  } else {
    found = find_camera(history.problem, state_, params_, options);
  }
  const ImageCorrection before = state_.applied;
  std::optional<MapMoved> moved;
  state_ = found.state;
  if (found.estimate) {
    const TraceScope traced("prior of the corrected map");
    moved = make_move(rectification_, before, keyframes, map.marginalised().size(), history, options,
                      &*found.estimate);
    moved->segment = map.segment();
  }
  pass_checkpoint(known, at_end);
  return moved;
}

}  // namespace edgevo
