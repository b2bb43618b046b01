// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Self-calibration: camera properties that the camera file does not contain (edges/image_correction.h),
// namely the residual radial distortion k1 and the read-out time of a rolling shutter, estimated from the
// window's own matches during a run, and the focal length, which followed corners show, too
// (focal_by_corners.h).
//
// Not from the paper. A monocular map's scale grows or shrinks along a path when the lens model is wrong,
// however good the matches: depth is learnt near the image centre and used further out. A rolling shutter
// elongates the image of a camera that moves up or down, which looks like a step forward. Bundle adjustment
// sees both: its cost is lowest where neither happens. How:
//   1. The map keeps the matches of marginalised keyframes up to the last checkpoint (needs_matches()).
//   2. At a few checkpoints all of them and the window are adjusted together with all of these as global
//      unknowns (Newton on the profile cost), and k2, which is stated only: with what file and corners say,
//      their posterior (CameraPosterior::whole), by which the focal length is weighed. Then k1 and read-out
//      time are, with the focal length given (CameraPosterior::given).
//   3. A number is applied where the file's is `significance` standard deviations off and keyframes held back
//      do not speak against it: the result is a move of the map (MapMoved), with a new prior of the window;
//      Map::move() applies it.
// In realtime step 2 runs in a thread of its own; what was added to the map meanwhile is carried over when it
// is applied. After the last checkpoint no matches are needed any more: memory and time are bounded. A run
// that ends earlier is estimated at its end. A run that is too short, too straight or too still reports that
// and does not change the camera.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"
#include "edgevo/core/records.h"
#include "edgevo/map/map.h"
#include "edgevo/self_calibration/focal_by_corners.h"
#include "edgevo/self_calibration/self_calibration_params.h"

namespace edgevo {

/// The self-calibration of one run. One thread calls; an estimate may run in another.
class SelfCalibration {
 public:
  /// `rectification`: cameras of the raw and of the rectified images.
  SelfCalibration(const Rectification& rectification, const SelfCalibrationParams& params);
  SelfCalibration(SelfCalibration&&) noexcept;
  SelfCalibration& operator=(SelfCalibration&&) noexcept;
  /// Waits for an estimate that is running.
  ~SelfCalibration();

  /// Begins with the read-out time that an earlier look at the same frames has found; it is refined once
  /// there are more keyframes than that had.
  void begin_with(const CameraPosterior& found);
  /// True if the matches of marginalised keyframes are needed for later estimates.
  bool needs_matches() const { return !finished_ && params_.refine != "none"; }
  /// Takes what corners show of the focal length up to now.
  void note_focal_length(const FocalError& by_corners);
  /// True if corners show another focal length than is applied and no other estimate is running, and while
  /// theirs is. Corners do not know the map: it may be in doubt, and may be so because of the focal length.
  bool is_focal_length_due(const Map& map) const;
  /// True if a checkpoint is reached, or is_focal_length_due(), and no estimate is running.
  bool is_due(const Map& map) const;
  /// Estimates the camera from all keyframes of the map that have matches. Returns how the map is to move, if
  /// it is; `at_end`: even if it changes little.
  std::optional<MapMoved> estimate(const Map& map, const BaOptions& options, bool at_end);
  /// Begins an estimate in a thread of its own, on a copy of the matches. Once it is ready, estimate()
  /// returns it for the map at that time (sooner: waits for it). Cost: the copy, some 20 ms at 120 keyframes.
  void begin(const Map& map, const BaOptions& options);
  /// True from begin() until estimate() has returned the result.
  bool is_running() const { return job_ != nullptr; }
  /// True if an estimate that was begun has ended.
  bool is_ready() const;
  /// The correction that estimate() would apply, if one that was begun has ended with one: what depends on it
  /// alone may be prepared.
  std::optional<ImageCorrection> correction_found();
  /// Drops an estimate that is running, at the end of a segment. What was found stays.
  void cancel();

  /// Results so far.
  const CameraPosterior& state() const { return state_; }

 private:
  struct Job;
  void pass_checkpoint(int keyframes, bool at_end);

  Rectification rectification_;
  SelfCalibrationParams params_;
  CameraPosterior state_;
  int next_checkpoint_;
  /// True if the last checkpoint has passed.
  bool finished_ = false;
  /// The estimate that is running; null if none is.
  std::unique_ptr<Job> job_;
};

}  // namespace edgevo
