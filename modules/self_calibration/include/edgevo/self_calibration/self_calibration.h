#pragma once
// Self-calibration: what the camera file does not know (edges/image_correction.h), the residual radial
// distortion k1 and the read-out time of a rolling shutter, estimated from the window's own matches while the
// odometry runs.
//
// Not from the paper. A monocular map's scale grows or shrinks along a drive when the lens model is wrong,
// however good the matches: depth is learnt near the image centre and used further out. A rolling shutter
// stretches the image of a camera that moves up or down, and that looks like a step forward. The bundle
// adjustment sees both: its cost has a minimum where the growth, and the stretch, ends. How:
//   1. Keyframes that leave the window are remembered with their matches, without images, up to the last
//      checkpoint.
//   2. At a few checkpoints all of them and the window are adjusted together with k1 as a global unknown
//      (Newton on the profile cost). Where one more step with both free makes the shutter look like a rolling
//      one, the read-out time is estimated, too.
//   3. Is either `significance` standard deviations from what is applied now, it is applied: poses, depths
//      and matches move to the adjusted ones, anchored at the newest keyframe, whose pose and scale stay what
//      they are, and the window's prior is formed again.
// In realtime step 2 runs in a thread of its own; what was added to the map meanwhile is carried over when it
// is applied. After the last checkpoint nothing is remembered any more: memory and time are bounded. A run
// that ends earlier is estimated at its end. A run too short, too straight or too still to tell says so and
// leaves the camera alone.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"
#include "edgevo/core/params.h"
#include "edgevo/core/records.h"
#include "edgevo/mapping/keyframe.h"
#include "edgevo/mapping/map_revision.h"

namespace edgevo {

/// Parameters of the self-calibration.
struct SelfCalibrationParams {
  /// "none", "k1", "readout" or "all"
  std::string refine = "all";
  /// keyframes
  int min_keyframes = 30;
  /// standard deviations
  double significance = 3.0;
  /// s
  double readout_s = 0;
  /// A change of the read-out time is applied with a third more: matches of crooked rows hold on to them.
  bool over_relax_readout = true;

  /// Rows may have a time of their own.
  bool knows_rolling() const { return readout_s != 0 || refines_readout(); }
  /// k1 is estimated.
  bool refines_k1() const { return refine == "k1" || refine == "all"; }
  /// The read-out time is estimated.
  bool refines_readout() const { return refine == "readout" || refine == "all"; }

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

/// The self-calibration of one run. One thread calls; an estimate may run in another.
class SelfCalibration {
 public:
  /// `pinhole`: of the undistorted images
  SelfCalibration(const Pinhole& pinhole, const SelfCalibrationParams& params);
  SelfCalibration(SelfCalibration&&) noexcept;
  SelfCalibration& operator=(SelfCalibration&&) noexcept;
  ~SelfCalibration();  ///< waits for an estimate that is running

  /// A keyframe that leaves the window; its images are not kept.
  void remember(const Keyframe& keyframe);
  /// A checkpoint is reached, and no estimate is running.
  bool is_due(int window_keyframes) const;
  /// Estimates what is wrong with the camera from all that is remembered and the window. A revision if it is
  /// to be applied; `at_end`: even if it changes little.
  std::optional<MapRevision> estimate(const std::vector<const Keyframe*>& window, const BaOptions& options,
                                      bool at_end);
  /// Begins that estimate in a thread of its own, on a copy of the matches; when it is ready, estimate()
  /// hands it over for the window as it is by then (sooner: waits for it). Cost: the copy, some 20 ms at 120
  /// keyframes.
  void begin(const std::vector<const Keyframe*>& window, const BaOptions& options);
  /// begin() was called, and estimate() has not handed it over
  bool is_running() const { return job_ != nullptr; }
  bool is_ready() const;  ///< an estimate that was begun has ended
  /// Starts over: a segment has ended. What was found stays.
  void forget();

  const CameraRefinement& state() const { return state_; }  ///< what was found so far

 private:
  struct Job;
  std::vector<const Keyframe*> all_keyframes(const std::vector<const Keyframe*>& window) const;
  void pass_checkpoint(int keyframes, bool at_end);

  Pinhole pinhole_;
  SelfCalibrationParams params_;
  CameraRefinement state_;
  std::vector<Keyframe> history_;  ///< without images
  int next_checkpoint_;
  bool finished_ = false;     ///< the last checkpoint has passed
  std::unique_ptr<Job> job_;  ///< an estimate that is running
};

}  // namespace edgevo
