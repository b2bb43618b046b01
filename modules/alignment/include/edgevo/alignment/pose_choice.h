// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Selects the pose of a frame: hypotheses are proposed, each is aligned with the image, and one score decides
// which wins.
//
// An alignment converges to the minimum nearest to its start, and there are several: where edges repeat,
// where shadows move, after an unpredicted turn. So there are several hypotheses, from the likeliest and
// cheapest to the most expensive; the expensive ones are tried only if the poses found so far are not good
// enough.
#include <functional>
#include <optional>
#include <vector>

#include "edgevo/alignment/edge_alignment.h"
#include "edgevo/alignment/pose_evidence.h"

namespace edgevo {

/// A pose to try, and how it is refined.
struct PoseHypothesis {
  /// Alignment steps that start from the hypothesis.
  enum class Refinement {
    /// Far from the truth: gray patches on the coarse levels, then edges on two levels.
    kPatchesThenEdges,
    /// Near the truth: edges on two levels.
    kEdges,
    /// Rotation and direction are known: the length of the translation is searched from half to twice its
    /// value, then edges are aligned.
    kLengthThenEdges,
    /// Rotation and direction are known better than by edges: only the length is searched, from half to
    /// twice its value.
    kLength,
    /// The same, within an eighth of its value.
    kNearLength,
    /// Almost exact already: edges on the finest level only.
    kFinestEdges,
  };
  /// Pose of the hypothesis, reference to current camera.
  SE3 T_cur_ref;
  /// Refinement that fits its distance from the truth.
  Refinement refinement = Refinement::kPatchesThenEdges;
  /// Standard deviation of the translation along each camera axis, unit of the map; empty: the alignment uses
  /// no prior.
  std::optional<Eigen::Vector3d> translation_sigma = std::nullopt;
  /// Prior on the rotation; empty: none. Not with kLength and kNearLength.
  std::optional<RotationPrior> turn = std::nullopt;
};

/// Aligned pose of a hypothesis.
struct PoseCandidate {
  /// Aligned pose, reference to current camera.
  SE3 T_cur_ref;
  /// Outcome of the last alignment, on the finest level.
  AlignmentStats stats;
  /// Support by the image alone, without the prior.
  PoseEvidence evidence;
  /// Whether the alignment used a prior on the translation.
  bool has_prior = false;
  /// The prior on the rotation that it used.
  std::optional<RotationPrior> turn = {};
};

/// Aligns a hypothesis with the current frame. Cost for 1500 points at 1241x376: 3 ms with patches, 1 ms with
/// edges alone; kLengthThenEdges and kLength add 13 and 26
/// evaluations of the edge cost.
PoseCandidate align(const FramePyramid& current, const ReferenceCloud& cloud,
                    const PoseHypothesis& hypothesis, const AlignmentParams& params);

/// Rates poses by their measurements. Alignment only measures; the caller decides what is good enough
/// (confidence/frame_status.h).
class PoseScorer {
 public:
  virtual ~PoseScorer() = default;
  /// Whether the image supports the pose so well that no further hypotheses are tried.
  virtual bool fits(const PoseCandidate& pose) const = 0;
  /// Score of a pose: higher is better.
  virtual double score(const PoseCandidate& pose) const = 0;
};

/// Source of a hypothesis.
enum class ProposerKind {
  /// Motions extrapolated from the last ones (motion_hypotheses()).
  kStarts,
  /// Rotations around the predicted pose (rotation_search.h).
  kRotations,
  /// Median motion of a camera that moves at constant speed.
  kMedianMotion,
  /// Corners tracked from the reference image.
  kCorners,
};

/// A source of pose hypotheses.
struct Proposer {
  /// Kind that PoseChoice reports with the winning pose.
  ProposerKind kind;
  /// Whether another hypothesis of this proposer is needed, given the best pose so far. Evaluated before each
  /// hypothesis except the very first of the frame.
  std::function<bool(const PoseCandidate& best)> is_called_for;
  /// Generates the hypotheses, likeliest first, when the first of them is needed.
  std::function<std::vector<PoseHypothesis>()> hypotheses;
};

/// The selected pose and the effort of finding it.
struct PoseChoice {
  /// Winning pose.
  PoseCandidate pose;
  /// Kind of the proposer whose hypothesis won.
  ProposerKind kind = ProposerKind::kStarts;
  /// Number of hypotheses tried; 1 if the first was good enough.
  int hypotheses_tried = 0;
};

/// Aligns the hypotheses that are needed and returns the one with the highest score, the earliest on a tie.
/// The first proposer must have a hypothesis.
PoseChoice choose(const std::vector<Proposer>& proposers, const FramePyramid& current,
                  const ReferenceCloud& cloud, const PoseScorer& scorer, const AlignmentParams& params);

}  // namespace edgevo
