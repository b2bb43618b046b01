// SPDX-License-Identifier: BSD-3-Clause
#include "experiments.h"

#include <cstdio>
#include <utility>

namespace edgevo {
namespace {

using Experiments = std::vector<Experiment>;

constexpr std::pair<const char*, const PatchComparison& (*)()> kCosts[] = {
    {"gradient", gradient_comparison}, {"intensity", intensity_comparison}, {"census", census_comparison}};

std::shared_ptr<const PairMatcher> ours(const AssociationParams& params,
                                        const PatchComparison& comparison = gradient_comparison()) {
  return association_matcher(params, comparison);
}

// As in the paper: without refinement along the normal.
AssociationParams paper() {
  AssociationParams params;
  params.refine = false;
  return params;
}

AssociationParams refined() {
  AssociationParams params;
  params.refine = true;
  return params;
}

AssociationParams edge_matches_only() {
  AssociationParams params = paper();
  params.photometric = false;
  return params;
}

// Search length by the formula alone: without the floor of 2 px, with the cap. 0: edge matches; max: the cap
// for all.
void add_search_lengths(const StudyOptions& options, Experiments* all) {
  const std::pair<const char*, double> kRatios[] = {
      {"0.25", 0.25}, {"0.5", 0.5}, {"1", 1}, {"2", 2}, {"4", 4}};
  for (const auto& [method, comparison] : kCosts) {
    int position = 0;
    const auto add = [&, method = method, comparison = comparison](const char* setting,
                                                                   const AssociationParams& params) {
      all->push_back({"search_length", method, setting, position++, options.distance, false,
                      ours(params, comparison())});
    };
    add("0", edge_matches_only());
    for (const auto& [setting, k] : kRatios) {
      AssociationParams params = paper();
      params.k_p = params.k_mu = k;
      params.min_search_px = 0;
      add(setting, params);
    }
    AssociationParams fixed_length = paper();
    fixed_length.min_search_px = fixed_length.max_search_px;
    add("max", fixed_length);
  }
}

void add_patch_sizes(const StudyOptions& options, Experiments* all) {
  for (const auto& [method, comparison] : kCosts) {
    int position = 0;
    for (const int side : {3, 5, 7, 9, 11}) {
      AssociationParams params = paper();
      params.patch_side = params.max_patch_side = side;
      all->push_back({"patch_size", method, std::to_string(side), position++, options.distance, false,
                      ours(params, comparison())});
    }
    all->push_back(
        {"patch_size", method, "adaptive", position, options.distance, false, ours(paper(), comparison())});
  }
}

void add_distances(const StudyOptions& options, Experiments* all) {
  for (int distance = 1; distance <= options.max_distance; ++distance) {
    const auto add = [&](const char* method, std::shared_ptr<const PairMatcher> matcher) {
      all->push_back({"frame_distance", method, std::to_string(distance), distance, distance, false,
                      std::move(matcher)});
    };
    for (const auto& [method, comparison] : kCosts) add(method, ours(paper(), comparison()));
    add("gradient_refined", ours(refined()));
    add("edge_matches", ours(edge_matches_only()));
    add("front_end", nullptr);
    add("lucas_kanade", lucas_kanade_matcher());
    add("epipolar_flow", epipolar_flow_matcher());
  }
}

// Two-dimensional residuals against those along the normal only, and both with the match refined along the
// normal.
void add_residuals(const StudyOptions& options, Experiments* all) {
  AssociationParams normal_only = paper(), refined_edge = edge_matches_only();
  normal_only.sigma_tangent_px = 0;
  refined_edge.refine = true;
  int position = 0;
  const auto add = [&](const char* method, std::shared_ptr<const PairMatcher> matcher) {
    all->push_back({"residuals", method, std::to_string(options.distance), position++, options.distance, true,
                    std::move(matcher)});
  };
  add("photometric_2d", ours(paper()));
  add("photometric_normal_only", ours(normal_only));
  add("edge_matches", ours(edge_matches_only()));
  add("photometric_2d_refined", ours(refined()));
  add("edge_matches_refined", ours(refined_edge));
  add("intensity_2d", ours(paper(), intensity_comparison()));
  add("census_2d", ours(paper(), census_comparison()));
  add("lucas_kanade", lucas_kanade_matcher());
  add("epipolar_flow", epipolar_flow_matcher());
}

// Variations of the odometry's parameters.
void add_variants(const StudyOptions& options, Experiments* all) {
  int position = 0;
  const auto add = [&](const char* name, int patch_side, int max_patch_side, bool refine,
                       double min_search_px) {
    AssociationParams params;
    params.patch_side = patch_side;
    params.max_patch_side = max_patch_side;
    params.refine = refine;
    params.min_search_px = min_search_px;
    all->push_back({"variants", name, std::to_string(options.distance), position++, options.distance, false,
                    ours(params)});
  };
  const AssociationParams d;
  add("default", d.patch_side, d.max_patch_side, d.refine, d.min_search_px);
  add("as_the_paper", d.patch_side, d.max_patch_side, false, d.min_search_px);
  add("refined", d.patch_side, d.max_patch_side, true, d.min_search_px);
  for (const bool refine : {false, true}) {
    add(refine ? "patch_7_to_11_refined" : "patch_7_to_11", 7, 11, refine, d.min_search_px);
    add(refine ? "patch_9_refined" : "patch_9", 9, 9, refine, d.min_search_px);
    add(refine ? "patch_11_refined" : "patch_11", 11, 11, refine, d.min_search_px);
    add(refine ? "search_4_px_refined" : "search_4_px", d.patch_side, d.max_patch_side, refine, 4);
    add(refine ? "patch_9_search_4_px_refined" : "patch_9_search_4_px", 9, 9, refine, 4);
  }
}

// All matches are accepted, with patches of one size, so that the confidences have a range to rank.
void add_confidences(const StudyOptions& options, Experiments* all) {
  AssociationParams accept_all = paper();
  accept_all.tau_m = 0;
  const std::string setting = std::to_string(options.distance);
  for (const auto& [method, comparison] : kCosts)
    all->push_back(
        {"confidence", method, setting, 0, options.distance, true, ours(accept_all, comparison())});
  all->push_back(
      {"confidence", "edge_matches", setting, 0, options.distance, true, ours(edge_matches_only())});
}

}  // namespace

Experiments make_experiments(const StudyOptions& options) {
  Experiments all;
  add_search_lengths(options, &all);
  add_patch_sizes(options, &all);
  add_distances(options, &all);
  add_residuals(options, &all);
  add_variants(options, &all);
  add_confidences(options, &all);
  return all;
}

}  // namespace edgevo
