// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/pose_choice.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace edgevo {
namespace {

// The coarse patch alignment ends on this pyramid level.
constexpr int kFinestPatchLevel = 1;

// Edges are aligned on two levels, if the pyramid has as many with edges.
int coarsest_edge_level(const FramePyramid& pyramid) {
  int levels = 0;
  while (levels < int(pyramid.levels.size()) && !pyramid.levels[levels].gradient_magnitude.empty()) ++levels;
  return std::min(levels, 2) - 1;
}

// Glare and shadows mislead gray levels where the edges of the scene run along the motion. So the edge cost
// decides whether to continue from the pose of the patch alignment or from the start itself
// (lab 2026-11-21_edges_along_the_motion).
SE3 start_by_patches(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& start,
                     const AlignmentParams& params) {
  const int coarsest = int(current.levels.size()) - 1;
  SE3 T_cur_ref = start;
  align_patches(current, cloud, coarsest, std::min(kFinestPatchLevel, coarsest), &T_cur_ref);
  if (!params.verify_patch_start) return T_cur_ref;
  const int level = coarsest_edge_level(current);
  const bool misled =
      edge_cost(current, cloud, level, params, start) < edge_cost(current, cloud, level, params, T_cur_ref);
  return misled ? start : T_cur_ref;
}

// Translation from 1 / `most` to `most` times its length that the edges of a level fit best.
SE3 search_length(const FramePyramid& current, const ReferenceCloud& cloud, int level, double most,
                  const SE3& start, const AlignmentParams& params) {
  constexpr int kSteps = 6;  // in each direction
  SE3 best = start;
  double least = std::numeric_limits<double>::infinity();
  for (int i = -kSteps; i <= kSteps; ++i) {
    const SE3 T_cur_ref(start.rotation(), std::pow(most, double(i) / kSteps) * start.translation());
    const double cost = edge_cost(current, cloud, level, params, T_cur_ref);
    if (cost < least) least = cost, best = T_cur_ref;
  }
  return best;
}

// Neighbours differ by an eighth of the length.
SE3 start_by_length(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& start,
                    const AlignmentParams& params) {
  return search_length(current, cloud, coarsest_edge_level(current), 2, start, params);
}

// The length to a fiftieth, of a start that is right to an eighth.
PoseCandidate align_length(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& start,
                           const AlignmentParams& params) {
  constexpr double kNear = 1.13;
  PoseCandidate found;
  found.T_cur_ref = search_length(current, cloud, 0, kNear, start, params);
  SE3 aligned = found.T_cur_ref;  // where the edges would have it; only its statistics count
  found.stats = align_edges(current, cloud, 0, params, &aligned);
  if (found.T_cur_ref.is_finite()) found.evidence = weigh_evidence(current, cloud, found.T_cur_ref, params);
  return found;
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
  using Refinement = PoseHypothesis::Refinement;
  if (h.refinement == Refinement::kNearLength) return align_length(current, cloud, h.T_cur_ref, params);
  if (h.refinement == Refinement::kLength)
    return align_length(current, cloud, start_by_length(current, cloud, h.T_cur_ref, params), params);
  PoseCandidate found;
  found.T_cur_ref = start_of_edges(current, cloud, h, params);
  found.has_prior = h.translation_sigma.has_value();
  found.turn = h.turn;
  TranslationPrior prior;
  if (h.translation_sigma) prior = {h.T_cur_ref, *h.translation_sigma};
  const int coarsest = h.refinement == Refinement::kFinestEdges ? 0 : coarsest_edge_level(current);
  for (int level = coarsest; level >= 0; --level)
    found.stats = align_edges(current, cloud, level, params, &found.T_cur_ref,
                              found.has_prior ? &prior : nullptr, h.turn ? &*h.turn : nullptr);
  if (found.T_cur_ref.is_finite()) found.evidence = weigh_evidence(current, cloud, found.T_cur_ref, params);
  return found;
}

PoseChoice choose(const std::vector<Proposer>& proposers, const FramePyramid& current,
                  const ReferenceCloud& cloud, const PoseScorer& scorer, const AlignmentParams& params) {
  PoseChoice best;
  const auto is_called_for = [&](const Proposer& p) {
    return best.hypotheses_tried == 0 || p.is_called_for(best.pose);
  };
  for (const Proposer& proposer : proposers) {
    if (!is_called_for(proposer)) continue;
    for (const PoseHypothesis& hypothesis : proposer.hypotheses()) {
      if (!is_called_for(proposer)) break;
      PoseCandidate candidate = align(current, cloud, hypothesis, params);
      if (++best.hypotheses_tried > 1 && !(scorer.score(candidate) > scorer.score(best.pose))) continue;
      best.pose = std::move(candidate);
      best.kind = proposer.kind;
    }
  }
  return best;
}

}  // namespace edgevo
