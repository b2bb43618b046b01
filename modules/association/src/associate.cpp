// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/association/associate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "edgevo/alignment/projection.h"
#include "edgevo/association/normal_refinement.h"
#include "edgevo/association/patch_source.h"
#include "edgevo/association/uncertainty.h"

namespace edgevo {
namespace {

// Pixels of an edge: the largest max_search_px, 30, in each direction, and the middle.
constexpr int kMaxCandidates = 64;
// A first patch of 5x5 pixels, and the pixel beyond it that interpolation reads.
constexpr double kBorderPx = 3;
// Curvature of the cost over the candidates; a flatter cost has no sub-pixel minimum.
constexpr double kMinCurvature = 1e-9;
// Largest distance of an edge match from the prediction, along the edge normal and in total.
constexpr double kMaxNormalPx = 4.0;
constexpr double kMaxDistancePx = 2 * kMaxNormalPx;
// Gate on the angle between the two edge normals, signed: 45 degrees.
constexpr double kMinNormalCosine = 0.7;
// Searches up to this half length skip the confidence check (tau_lambda in the paper); at 0 none does.
constexpr double kTauLambdaPx = 0;
// Floor of sigma_(p||g) in C_d.
constexpr double kMinProjectionSigmaPx = 0.5;

// Edge pixels along the edge on both sides of `centre`, with arc length from it.
struct Walk {
  std::array<int, kMaxCandidates> pixel;
  std::array<double, kMaxCandidates> arc;  // pixels, negative before the centre
  int count = 0;
};

Walk walk_along_edge(const ImageEdges& edges, int centre, double half_length) {
  Walk walk;
  std::array<int, kMaxCandidates / 2> before, after;
  std::array<double, kMaxCandidates / 2> arc_before, arc_after;
  const auto go = [&](int step, auto& pixel, auto& arc) {
    int n = 0;
    double length = 0;
    for (int i = centre, j = edges.neighbour(i, step); j >= 0 && n < kMaxCandidates / 2 - 1;
         i = j, j = edges.neighbour(j, step)) {
      length += (edges.pixels[j].position() - edges.pixels[i].position()).norm();
      if (length > half_length) break;
      pixel[n] = j;
      arc[n++] = length;
    }
    return n;
  };
  const int n_before = go(-1, before, arc_before), n_after = go(+1, after, arc_after);
  for (int k = n_before - 1; k >= 0; --k)
    walk.pixel[walk.count] = before[k], walk.arc[walk.count++] = -arc_before[k];
  walk.pixel[walk.count] = centre, walk.arc[walk.count++] = 0;
  for (int k = 0; k < n_after; ++k) walk.pixel[walk.count] = after[k], walk.arc[walk.count++] = arc_after[k];
  return walk;
}

struct TemplateMatch {
  bool found = false;
  int best = 0;  // index into the walk
  double cost = kWorstPatchCost, confidence = 0;
  double offset = 0;  // sub-pixel, in candidates, [-0.5, 0.5]
};

TemplateMatch match_template(const PatchComparison& comparison, const Patch& patch,
                             const PyramidLevel& target, const Walk& walk, double sigma_c) {
  TemplateMatch m;
  std::array<double, kMaxCandidates> cost;
  for (int k = 0; k < walk.count; ++k) {
    const EdgePixel& e = target.edges.pixels[walk.pixel[k]];
    cost[k] = comparison.cost(patch, target, e.x, e.y);
    if (cost[k] < cost[m.best]) m.best = k;
  }
  m.cost = cost[m.best];
  m.confidence = aml_confidence(cost.data(), walk.count, m.cost, sigma_c);
  m.found = m.cost < kWorstPatchCost;
  if (m.best > 0 && m.best + 1 < walk.count) {
    const double a = cost[m.best - 1], b = cost[m.best + 1], curvature = a - 2 * m.cost + b;
    if (curvature > kMinCurvature && a < kWorstPatchCost && b < kWorstPatchCost)
      m.offset = std::clamp(0.5 * (a - b) / curvature, -0.5, 0.5);
  }
  return m;
}

// Position between the best candidate and its neighbour on the edge.
Eigen::Vector2d position_on_edge(const ImageEdges& edges, const Walk& walk, const TemplateMatch& m) {
  const Eigen::Vector2d at = edges.pixels[walk.pixel[m.best]].position().cast<double>();
  const int neighbour = m.best + (m.offset > 0 ? 1 : -1);
  if (m.offset == 0 || neighbour < 0 || neighbour >= walk.count) return at;
  const Eigen::Vector2d next = edges.pixels[walk.pixel[neighbour]].position().cast<double>();
  return at + std::abs(m.offset) * (next - at);
}

// The nearest edge pixel that passes the gates on distance and orientation; -1 if none.
int find_edge(const PyramidLevel& target, const Eigen::Vector2d& p, const Eigen::Vector2d& predicted_normal) {
  const int n = target.field.nearest(float(p.x()), float(p.y()));
  if (n < 0) return -1;
  const EdgePixel& e = target.edges.pixels[n];
  const Eigen::Vector2d g = e.normal().cast<double>();
  if (!(g.dot(predicted_normal) >= kMinNormalCosine)) return -1;
  const Eigen::Vector2d d = e.position().cast<double>() - p;
  return std::abs(g.dot(d)) <= kMaxNormalPx && d.norm() <= kMaxDistancePx ? n : -1;
}

// Searches along the edge, growing the patch while the match is ambiguous. True if a confident match was
// found.
bool search_photometric(const AssociationQuery& q, const Eigen::Matrix2d& A, int centre,
                        const AssociationParams& params, const PatchComparison& comparison, Match* match) {
  const PatchSource host = patch_source(*q.host, q.px_host, A);
  const PyramidLevel& target = q.target->finest();
  const Walk walk = walk_along_edge(target.edges, centre, match->search_px);
  const int last_side = std::max(params.patch_side, params.max_patch_side);
  for (int side = params.patch_side; side <= last_side; side += 2) {
    Patch patch;
    if (!comparison.cut(*host.level, host.px, host.A_target_host, side / 2, &patch)) return false;
    const TemplateMatch m = match_template(comparison, patch, target, walk, params.sigma_c);
    match->patch_side = side;
    match->cost = m.cost;
    match->match_confidence = m.confidence;
    if (!m.found || m.cost > params.max_cost) return false;
    // Ambiguous: grow the patch.
    if (m.confidence < params.tau_m && match->search_px > kTauLambdaPx) continue;
    match->px = position_on_edge(target.edges, walk, m);
    match->normal = target.edges.pixels[walk.pixel[m.best]].normal().cast<double>();
    return true;
  }
  return false;
}

void refine(const AssociationQuery& q, const Eigen::Matrix2d& A, Match* match) {
  const PatchSource host = patch_source(*q.host, q.px_host, A);
  NormalTemplate patch;
  const bool is_made = host.level->with_gray([&](const auto& gray) {
    return make_normal_template(gray, host.px, host.A_target_host, match->normal, kRefinementRadius, &patch);
  });
  if (!is_made) {
    match->kind = MatchKind::kNone;
    return;
  }
  const NormalRefinement r = q.target->finest().with_gray(
      [&](const auto& gray) { return refine_along_normal(patch, gray, match->px, match->normal); });
  if (!r.accepted) {
    match->kind = MatchKind::kNone;
    return;
  }
  match->px = r.px;
  match->refined = true;
}

void weigh(const AssociationParams& params, Match* match) {
  match->inv_sigma_normal = 1.0 / (match->refined ? params.sigma_refined_px : params.sigma_normal_px);
  match->inv_sigma_tangent = match->kind == MatchKind::kPhotometric && params.sigma_tangent_px > 0
                                 ? 1.0 / params.sigma_tangent_px
                                 : 0.0;
}

}  // namespace

void AssociationParams::visit(ParamVisitor& v) {
  v.number(kAdvanced, "k_p", k_p, 0, 100, "gain of the pose uncertainty in the search length");
  v.number(kAdvanced, "k_mu", k_mu, 0, 100, "gain of the depth uncertainty in the search length");
  v.number(kAdvanced, "min_search_px", min_search_px, 0, 15,
           "floor of the half search length, since the pose covariance is optimistic, pixels");
  v.number(kAdvanced, "max_search_px", max_search_px, 0, 30, "cap of the half search length, pixels");
  v.boolean(kAdvanced, "photometric", photometric,
            "search along the edge by patches (paper); false: edge matches only");
  v.odd(kAdvanced, "patch_side", patch_side, 3, 11, "first patch size S_p, pixels");
  v.odd(kAdvanced, "max_patch_side", max_patch_side, 3, 11,
        "patches grow up to tau_S, pixels; a larger first size does not grow");
  v.number(kAdvanced, "max_cost", max_cost, 0.01, 2, "a best patch that costs more is no match");
  v.number(kAdvanced, "sigma_c", sigma_c, 1e-3, 1, "standard deviation of costs in the AML confidence");
  v.number(kAdvanced, "tau_m", tau_m, 0, 1, "match confidence below which a match is ambiguous");
  v.number(kAdvanced, "min_depth_confidence", min_depth_confidence, 0, 100,
           "ambiguous matches below it keep their depth fixed, 1/px");
  v.boolean(kAdvanced, "refine", refine, "one-dimensional refinement of matches along the edge normal");
  v.number(kAdvanced, "k_m", k_m, 0.1, 10,
           "matches further along the edge than this share of the search length are searched again");
  v.number(kAdvanced, "sigma_normal_px", sigma_normal_px, 0.01, 10,
           "standard deviation of an edge match along the normal, pixels");
  v.number(kAdvanced, "sigma_refined_px", sigma_refined_px, 0.01, 10,
           "standard deviation of a refined match along the normal, pixels");
  v.number(kAdvanced, "sigma_tangent_px", sigma_tangent_px, 0, 100,
           "standard deviation of a photometric match along the edge, pixels; 0: unused");
}

Match associate(const AssociationQuery& q, const AssociationParams& params) {
  return associate(q, params, gradient_comparison());
}

Match associate(const AssociationQuery& q, const AssociationParams& params,
                const PatchComparison& comparison) {
  Match match;
  const PyramidLevel& target = q.target->finest();
  const Pinhole& camera = target.pinhole;
  const Eigen::Vector3d ray = camera.ray(q.px_host);
  const Projection p = project(camera, q.T_target_host.R(), q.T_target_host.translation(), ray, q.idepth);
  if (!p.valid || !camera.contains(p.px, kBorderPx)) return match;
  const Eigen::Matrix2d A = patch_warp(camera, q.T_target_host, q.px_host, q.idepth);
  const int centre = find_edge(target, p.px, warp_normal(A, q.normal_host));
  if (centre < 0) return match;

  const EdgePixel& edge = target.edges.pixels[centre];
  match.normal = edge.normal().cast<double>();
  const Eigen::Matrix2d Sigma_p = projection_covariance(camera, p.Y, q.idepth, q.pose_covariance);
  const DepthMotion depth = depth_motion(camera, q.T_target_host, ray, q.idepth, q.idepth_sigma);
  match.search_px = std::clamp(search_half_length(Sigma_p, depth, match.normal, params.k_p, params.k_mu),
                               params.min_search_px, std::max(params.min_search_px, params.max_search_px));
  match.depth_confidence = depth_confidence(Sigma_p, depth.direction, match.normal, kMinProjectionSigmaPx);

  if (params.photometric && search_photometric(q, A, centre, params, comparison, &match)) {
    match.kind = MatchKind::kPhotometric;
  } else {
    // The patch looks like something else.
    if (params.photometric && match.cost > 0 && match.cost > params.max_cost) return match;
    // The foot of the projection on the tangent of the edge: an edge match does not constrain the position
    // along the edge.
    match.normal = edge.normal().cast<double>();
    match.px = p.px + match.normal * match.normal.dot(edge.position().cast<double>() - p.px);
    match.kind =
        match.depth_confidence < params.min_depth_confidence ? MatchKind::kEdgeFixed : MatchKind::kEdge;
  }
  if (params.refine) refine(q, A, &match);
  weigh(params, &match);
  return match;
}

bool needs_update(const Match& match, double residual_normal_px, double residual_tangent_px,
                  const AssociationParams& params) {
  constexpr double kMaxSigmas = 3.5;  // along the normal: exceeded by one in two thousand correct matches
  if (std::abs(residual_normal_px) * match.inv_sigma_normal > kMaxSigmas) return true;
  // Eq. (distancecheck)
  return std::abs(residual_tangent_px) > params.k_m * std::max(match.search_px, params.min_search_px);
}

}  // namespace edgevo
