#pragma once
// Which pose does a frame have? Hypotheses are proposed, each is aligned with the image, and one judge tells
// which wins.
//
// An alignment finds the minimum next to where it starts, and there are several: where edges repeat, where
// shadows move, after an unpredicted turn. So there are several hypotheses, from the likeliest and
// cheapest to the most expensive; the expensive ones are tried only where the poses found so far call for
// them.
#include <functional>
#include <optional>
#include <vector>

#include "edgevo/alignment/edge_alignment.h"
#include "edgevo/alignment/pose_evidence.h"

namespace edgevo {

/// Where the camera may be, and how it gets from there to where it is.
struct PoseHypothesis {
  /// What is aligned, from the hypothesis on.
  enum class Refinement {
    kPatchesThenEdges,  ///< from far: gray patches on the coarse levels, then edges on two
    kEdges,             ///< from near: edges on two levels
    kLengthThenEdges,   ///< rotation and direction are known: the translation's length is searched from half
                        ///< to twice, then edges
    kFinestEdges,       ///< nearly right already: edges on the finest level
  };
  SE3 T_cur_ref;                                          ///< reference to current camera
  Refinement refinement = Refinement::kPatchesThenEdges;  ///< how far it may be from the truth
  /// Standard deviation of its translation, axis by axis (camera axes, unit of the map); nothing: no prior
  /// holds the alignment to it.
  std::optional<Eigen::Vector3d> translation_sigma = std::nullopt;
};

/// Where a hypothesis led.
struct PoseCandidate {
  SE3 T_cur_ref;           ///< reference to current camera, aligned
  AlignmentStats stats;    ///< of the last alignment, on the finest level
  PoseEvidence evidence;   ///< of the image alone, whatever the prior
  bool has_prior = false;  ///< a prior held the alignment
};

/// Cost: with patches some 3 ms for 1500 points at 1241x376, edges alone 1 ms; kLengthThenEdges 13
/// evaluations of the edge cost more.
PoseCandidate align(const FramePyramid& current, const ReferenceCloud& cloud,
                    const PoseHypothesis& hypothesis, const AlignmentParams& params);

/// How well the image supports a pose, the worst first.
enum class TrackingQuality {
  /// The pose is not finite.
  kDiverged,
  /// Fewer than AlignmentParams::min_visible map points lie in view.
  kFewPoints,
  /// The inlier share is below AlignmentParams::lost_share.
  kUnsupported,
  /// The inlier share is below AlignmentParams::degraded_share.
  kWeak,
  kGood,
};
/// The quality decides whether a frame has a pose, whether more hypotheses are tried, and the state of the
/// frame.
TrackingQuality classify(const PoseCandidate& pose, const AlignmentParams& params);
/// Is there no pose?
inline bool is_lost(TrackingQuality quality) { return quality < TrackingQuality::kWeak; }

/// The one judge between poses of a frame: the support of the image (pose_evidence.h) times how likely the
/// motion is. A pose that left the prior it was held to is a compromise that neither image nor motion asks
/// for, and never wins: on a drive that speeds up evenly it would hold the camera back a little in frame
/// after frame (rendered street under mixed light: 0.07 instead of 0.03 m).
class PoseJudge {
 public:
  /// In (0, 1]: 1 for a motion that nothing speaks against.
  using Likelihood = std::function<double(const SE3& T_cur_ref)>;

  /// Keeps a reference to `params`; without a `likelihood` all motions are equally likely.
  explicit PoseJudge(const AlignmentParams& params, Likelihood likelihood = {})
      : params_(params), likelihood_(std::move(likelihood)) {}

  /// The pose is good enough to look no further, as far as the image goes.
  bool fits(const PoseCandidate& pose) const;
  /// The image supports it so little that there is no pose.
  bool is_lost(const PoseCandidate& pose) const;
  /// Higher is better; below 0: lost.
  double score(const PoseCandidate& pose) const;

 private:
  const AlignmentParams& params_;
  Likelihood likelihood_;
};

/// What a hypothesis rests on.
enum class ProposerKind {
  /// Motions that continue the last ones (motion_hypotheses()).
  kStarts,
  /// Rotations around the predicted pose (rotation_search.h).
  kRotations,
  /// The median motion of a camera that moves evenly.
  kMedianMotion,
  /// Corners, followed from the reference.
  kCorners,
};

/// One who knows where the camera may be.
struct Proposer {
  /// Told with the pose that won (PoseChoice).
  ProposerKind kind;
  /// Asked before each of its hypotheses but the first of all: is it called for, after what was found so far?
  std::function<bool(const PoseCandidate& best)> is_called_for;
  /// Its hypotheses, likeliest first; made when the first of them is called for.
  std::function<std::vector<PoseHypothesis>()> hypotheses;
};

/// The pose that won, and what it took to find it.
struct PoseChoice {
  PoseCandidate pose;                         ///< the winner
  ProposerKind kind = ProposerKind::kStarts;  ///< of the proposer whose hypothesis won
  int hypotheses_tried = 0;                   ///< 1: the first was good
};

/// The best of all that is called for; of equals the first. The first proposer has a hypothesis.
PoseChoice choose(const std::vector<Proposer>& proposers, const FramePyramid& current,
                  const ReferenceCloud& cloud, const PoseJudge& judge, const AlignmentParams& params);

}  // namespace edgevo
