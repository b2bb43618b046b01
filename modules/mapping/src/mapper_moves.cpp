// SPDX-License-Identifier: BSD-3-Clause
// What moves the map of Mapper as a whole: self-calibration, and other producers of moves; and doubt.
#include <algorithm>
#include <stdexcept>

#include "edgevo/confidence/integrity_monitor.h"
#include "edgevo/core/stage_timer.h"
#include "edgevo/core/trace.h"
#include "edgevo/mapping/mapper.h"
#include "rebuilt_images.h"

namespace edgevo {

// ---- self-calibration, and other moves ----

// Due at a few checkpoints only.
void Mapper::calibrate_if_due(StageTimes* times) {
  if (!calibration_.is_running() && !calibration_.is_due(*map_)) return;
  const StageTimer timer(Stage::kSelfCalibration, times);
  calibrate_during_run();
}

// Another producer of moves than self-calibration; a recognition of places plugs in here.
void Mapper::move_if_proposed() {
  if (!options_.move_map) return;
  std::optional<MapMoved> moved = options_.move_map(*map_);
  if (!moved) return;
  // The images to come are corrected by the state of self-calibration.
  if (moved->lens) throw std::invalid_argument("move of the map: only self-calibration changes the lens");
  move_map(std::move(*moved));
}

void Mapper::calibrate_during_run() {
  if (options_.own_threads)
    calibrate_concurrently();
  else
    calibrate(false);
}

// The estimate, and then the images for it, are made in threads of their own.
void Mapper::calibrate_concurrently() {
  if (!calibration_.is_running()) return calibration_.begin(*map_, calibration_options());
  if (!calibration_.is_ready()) return;
  const std::optional<ImageCorrection> correction = calibration_.correction_found();
  // It is left to the frames that make no keyframe. By the time the window has changed, the first images are
  // of no use any more.
  if (correction && ++keyframes_prepared_ <= params_.window.keyframes) {
    corrected_images_->prepare(map_->active(), *correction);
    return;
  }
  end_concurrent_calibration();
}

// Between two keyframes all images can be there, as that of a keyframe that has just come cannot. So the
// correction is not added to the work for a keyframe either.
void Mapper::correct_between_keyframes(StageTimes* times) {
  if (!options_.own_threads || !calibration_.is_ready()) return;
  const std::optional<ImageCorrection> correction = calibration_.correction_found();
  if (!correction) return;
  const StageTimer timer(Stage::kSelfCalibration, times);
  keyframes_prepared_ = std::max(keyframes_prepared_, 1);
  if (!is_prepared(*correction)) return;
  end_concurrent_calibration();
  publish_again();
}

bool Mapper::is_prepared(const ImageCorrection& correction) {
  return corrected_images_->prepare(map_->active(), correction) && edge_mapper_.is_idle();
}

void Mapper::end_concurrent_calibration() {
  corrected_images_->finish();
  calibrate(false);
  corrected_images_->clear();
  keyframes_prepared_ = 0;
}

BaOptions Mapper::calibration_options() const {
  BaOptions options;
  options.huber_width = params_.window.ba_huber;
  return options;
}

void Mapper::calibrate(bool at_end) {
  std::optional<MapMoved> moved = calibration_.estimate(*map_, calibration_options(), at_end);
  log_->append(CameraEstimated{calibration_.state()});
  if (moved) move_map(std::move(*moved));
}

void Mapper::move_map(MapMoved moved) {
  const TraceScope traced("move of the map");
  edge_mapper_.wait_idle();
  const std::optional<LensChange> lens = moved.lens;
  const MapMoved applied =
      map_->move(std::move(moved), [&](const Keyframe& k) { return corrected_images_->get(k, lens->now); });
  if (applied.prior) window_.set_prior(*applied.prior);
  edge_mapper_.apply(applied);
}

// ---- doubt ----

// The motion that is doubted reaches back.
void Mapper::note_doubt(const TrackedFrame& frame) {
  for (Keyframe& k : window_.keyframes())
    if (k.frame_index > frame.frame_index - kDoubtReach) k.is_doubtful = true;
}

// Keyframes that have left the window meanwhile stay doubtful.
void Mapper::confirm() {
  for (Keyframe& k : window_.keyframes()) k.is_doubtful = false;
}

// The reference after a move of the map.
void Mapper::publish_again() {
  for (const Keyframe& k : window_.keyframes())
    if (k.id == reference_->keyframe_id) return publish(k);
  publish(window_.newest());
}

}  // namespace edgevo
