#include "edgevo/alignment/pose_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "edgevo/core/rule.h"

namespace edgevo {
namespace {

// The coarse start by patches ends on this pyramid level.
constexpr int kFinestPatchLevel = 1;

// Edges are aligned on two levels, where the pyramid has so many with edges.
int coarsest_edge_level(const FramePyramid& pyramid) {
  int levels = 0;
  while (levels < int(pyramid.levels.size()) && !pyramid.levels[levels].gradient_magnitude.empty()) ++levels;
  return std::min(levels, 2) - 1;
}

// Glare and shadows mislead gray levels where the edges of the scene run along the motion: the edges
// choose where to go on from.
SE3 start_by_patches(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& start,
                     const AlignmentParams& params) {
  const int coarsest = int(current.levels.size()) - 1;
  SE3 T_cur_ref = start;
  align_patches(current, cloud, coarsest, std::min(kFinestPatchLevel, coarsest), &T_cur_ref);
  const int level = coarsest_edge_level(current);
  const bool misled =
      edge_cost(current, cloud, level, params, start) < edge_cost(current, cloud, level, params, T_cur_ref);
  return misled && rule("patches misled") ? start : T_cur_ref;
}

SE3 start_by_length(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& start,
                    const AlignmentParams& params) {
  constexpr int kSteps = 6;  // to either side: neighbours differ by an eighth of the length
  SE3 best = start;
  double least = std::numeric_limits<double>::infinity();
  for (int i = -kSteps; i <= kSteps; ++i) {
    const SE3 T_cur_ref(start.rotation(), std::exp2(double(i) / kSteps) * start.translation());
    const double cost = edge_cost(current, cloud, coarsest_edge_level(current), params, T_cur_ref);
    if (cost < least) least = cost, best = T_cur_ref;
  }
  return best;
}

SE3 start_of_edges(const FramePyramid& current, const ReferenceCloud& cloud, const PoseHypothesis& h,
                   const AlignmentParams& params) {
  using Refinement = PoseHypothesis::Refinement;
  if (h.refinement == Refinement::kPatchesThenEdges)
    return start_by_patches(current, cloud, h.T_cur_ref, params);
  if (h.refinement == Refinement::kLengthThenEdges)
    return start_by_length(current, cloud, h.T_cur_ref, params);
  return h.T_cur_ref;
}

}  // namespace

PoseCandidate align(const FramePyramid& current, const ReferenceCloud& cloud, const PoseHypothesis& h,
                    const AlignmentParams& params) {
  PoseCandidate found;
  found.T_cur_ref = start_of_edges(current, cloud, h, params);
  found.has_prior = h.translation_sigma.has_value();
  TranslationPrior prior;
  if (h.translation_sigma) prior = {h.T_cur_ref, *h.translation_sigma};
  const int coarsest =
      h.refinement == PoseHypothesis::Refinement::kFinestEdges ? 0 : coarsest_edge_level(current);
  for (int level = coarsest; level >= 0; --level)
    found.stats =
        align_edges(current, cloud, level, params, &found.T_cur_ref, found.has_prior ? &prior : nullptr);
  if (found.T_cur_ref.is_finite()) found.evidence = weigh_evidence(current, cloud, found.T_cur_ref, params);
  return found;
}

bool PoseJudge::fits(const PoseCandidate& pose) const {
  return pose.stats.visible >= params_.min_visible && pose.evidence.inlier_share >= params_.degraded_share;
}

bool PoseJudge::is_lost(const PoseCandidate& pose) const {
  return !pose.T_cur_ref.is_finite() || pose.stats.visible < params_.min_visible ||
         pose.evidence.inlier_share < params_.lost_share;
}

double PoseJudge::score(const PoseCandidate& pose) const {
  constexpr double kNever = -std::numeric_limits<double>::infinity();
  if (!pose.T_cur_ref.is_finite()) return kNever;
  const double likelihood = likelihood_ ? likelihood_(pose.T_cur_ref) : 1.0;
  if (pose.has_prior && likelihood < 1 && rule("usual step")) return kNever;
  const double by_image = support(pose.evidence, params_);
  return by_image > 0 ? likelihood * by_image : by_image;
}

PoseChoice choose(const std::vector<Proposer>& proposers, const FramePyramid& current,
                  const ReferenceCloud& cloud, const PoseJudge& judge, const AlignmentParams& params) {
  PoseChoice best;
  const auto is_called_for = [&](const Proposer& p) {
    return best.hypotheses_tried == 0 || p.is_called_for(best.pose);
  };
  for (size_t i = 0; i < proposers.size(); ++i) {
    if (!is_called_for(proposers[i])) continue;
    for (const PoseHypothesis& hypothesis : proposers[i].hypotheses()) {
      if (!is_called_for(proposers[i])) break;
      PoseCandidate candidate = align(current, cloud, hypothesis, params);
      if (++best.hypotheses_tried > 1 && !(judge.score(candidate) > judge.score(best.pose))) continue;
      best.pose = std::move(candidate);
      best.proposer = int(i);
    }
  }
  return best;
}

}  // namespace edgevo
