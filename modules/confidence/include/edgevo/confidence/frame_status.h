// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// From the evidence on a frame to its status, and into its record: assign_status() and assign_skipped() alone
// write it there. The same functions select among the candidate poses of a frame, so that the selected one is
// lost only if all are.
#include <functional>
#include <optional>
#include <string>

#include "edgevo/alignment/pose_choice.h"
#include "edgevo/confidence/motion_confidence.h"
#include "edgevo/confidence/status_params.h"
#include "edgevo/core/frame_evidence.h"
#include "edgevo/core/reason.h"
#include "edgevo/core/records.h"
#include "edgevo/core/tracking_state.h"

namespace edgevo {

/// How well the image supports a pose, worst first.
enum class PoseSupport {
  /// The pose is not finite.
  kDiverged,
  /// Fewer than `min_visible` map points lie in view.
  kFewPoints,
  /// The inlier share is below `lost_share`.
  kUnsupported,
  /// The inlier share is below `degraded_share`.
  kWeak,
  /// None of the above.
  kGood,
};
/// Support of the pose that the evidence was measured at.
PoseSupport classify(const FrameEvidence& evidence, const StatusParams& params);
/// Whether a frame whose pose has this support has no pose.
inline bool is_lost(PoseSupport support) { return support < PoseSupport::kWeak; }

/// Status of a tracked frame.
struct FrameStatus {
  /// kTracking, kDegraded, or kLost, which makes the pose meaningless.
  TrackingState state = TrackingState::kLost;
  /// Why the frame is degraded or lost; empty for kTracking.
  Reasons reasons;
};
/// Status of a frame that was tracked, by the support of its pose.
FrameStatus frame_status(const FrameEvidence& evidence, const StatusParams& params);
/// The same for a pose that is held while the camera stands: known from before, it needs no points in view.
FrameStatus status_at_zero_velocity(const FrameEvidence& evidence, StatusParams params);
/// Status of a frame that has a pose, in view of the confidence in its motion: DEGRADED below kDoubtfulBelow
/// (core/doubtful_frame.h), with the reason for the doubt after that of the image. A label only: tracking and
/// mapping go by the image.
FrameStatus frame_status(const FrameStatus& by_image, const FrameConfidence& trust);
/// Status of a frame whose pose is refused, as after a step beyond MotionHistory::largest_step(): LOST for
/// that reason, if there is one, unless the image has refused it already.
FrameStatus status_with_refusal(const FrameStatus& by_image, const std::optional<Reason>& reason);
/// Status of a frame whose pose the two-view reconstruction has given: TRACKING, or DEGRADED if the map
/// explains its image too little. `by_image`: nothing if the image is gone.
FrameStatus status_of_bootstrap_frame(const std::optional<FrameStatus>& by_image);
/// Writes state, reasons and note of a record.
void assign_status(FrameStatus status, FrameRecord* record);
/// The same for a frame that is skipped, with `note`.
void assign_skipped(TrackingState state, std::string note, FrameRecord* record);

/// Factor on the covariance of a pose with this p_right, 1 to 100: its inverse. Of a motion that is wrong
/// with the probability 1 - p the covariance says nothing.
double covariance_factor(double p_right);

/// The same thresholds with all least counts as `count` has them, e.g. for images of another size.
StatusParams with_counts(StatusParams params, const std::function<int(int)>& count);

/// Whether an image with that many edge pixels shows something to follow.
bool shows_edges(int edges, const StatusParams& params);
/// Whether next to nothing of the map is in view. Bad light leaves few points of known depth, too, but they
/// are in view: a new map would see no more of them.
bool is_out_of_view(const FrameEvidence& evidence, const StatusParams& params);
/// Whether most points, also those of guessed depth, lie on edges as well as in view of a map.
bool is_explained(const FrameEvidence& evidence);

/// Scores the candidate poses of a frame: support by the image (alignment/pose_evidence.h) times likelihood
/// of the motion. A pose that moved away from its prior never wins: it is a compromise that neither image nor
/// motion supports, and under constant acceleration it would hold the camera back a little in each frame
/// (rendered street under mixed light: 0.07 instead of 0.03 m).
class SupportScorer final : public PoseScorer {
 public:
  /// Likelihood of a motion, in (0, 1]; 1 for a motion without counter-evidence.
  using Likelihood = std::function<double(const SE3& T_cur_ref)>;

  /// Without a `likelihood` all motions are equally likely.
  explicit SupportScorer(const StatusParams& params, Likelihood likelihood = {})
      : params_(params), likelihood_(std::move(likelihood)) {}

  bool fits(const PoseCandidate& pose) const override;
  /// Score of a pose: higher is better, below 0 means lost.
  double score(const PoseCandidate& pose) const override;
  /// Whether the image supports the pose too little to accept it.
  bool is_lost(const PoseCandidate& pose) const;

 private:
  StatusParams params_;
  Likelihood likelihood_;
};

}  // namespace edgevo
