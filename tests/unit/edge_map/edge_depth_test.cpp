// SPDX-License-Identifier: BSD-3-Clause
// Depth of the edge pixels of an image, in a scene whose depth is exact.
#include "edgevo/edge_map/edge_depth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "depth_evidence.h"
#include "support/sweep_scene.h"

namespace edgevo {
namespace {

using test::Sweep;

EdgeView view_of(int host, int frame) {
  const auto pyramid = Sweep::pyramid(frame);
  return {pyramid, std::make_shared<const std::vector<EdgeSides>>(sample_sides(pyramid->finest())),
          test::sweep_pose(frame).inverse() * test::sweep_pose(host), 1};
}

std::vector<EdgePiece> depths_of(int host, const std::vector<int>& frames, const EdgeMapParams& params,
                                 double max_idepth = 2) {
  std::vector<EdgeView> views;
  for (const int f : frames) views.push_back(view_of(host, f));
  const auto pyramid = Sweep::pyramid(host);
  return find_edge_depths(Sweep::pinhole(), *pyramid, sample_sides(pyramid->finest()), views, max_idepth,
                          params);
}

struct Figures {
  /// Good: within 3 % of the true inverse depth.
  int nodes = 0, good = 0;
  std::vector<double> in_sigmas;
};

Figures figures_of(int host, const std::vector<EdgePiece>& pieces) {
  Figures f;
  for (const EdgePiece& piece : pieces)
    for (const EdgeNode& n : piece) {
      const Eigen::Vector2d px =
          Sweep::pyramid(host)->finest().edges.pixels[size_t(n.edge_pixel)].position().cast<double>();
      const double truth = Sweep::idepth(host, px);
      ++f.nodes;
      f.good += std::abs(n.idepth / truth - 1) < 0.03;
      f.in_sigmas.push_back(std::abs(n.idepth - truth) / n.idepth_sigma);
    }
  return f;
}

const std::vector<int> kAround{16, 8, 20, 4, 24, 0, 28, -4};

TEST(EdgeDepth, MostPixelsGetTheirDepth) {
  EdgeMapParams params;
  params.max_relative_sigma = 0.02;
  const Figures f = figures_of(12, depths_of(12, kAround, params));
  const double searched = double(Sweep::pyramid(12)->finest().edges.pixels.size()) / params.step_px;
  std::cout << "[ figures  ] " << f.nodes / searched << " of the edge pixels, " << double(f.good) / f.nodes
            << " of them within 3 %, median error " << median(f.in_sigmas) << " sigmas" << std::endl;
  EXPECT_GT(f.nodes, 0.33 * searched);  // measured 0.37: half of the edges here run along the motion
  EXPECT_GT(f.good, 0.92 * f.nodes);    // measured 0.948
  EXPECT_LT(median(f.in_sigmas), 0.9);  // measured 0.47
}

TEST(EdgeDepth, VerticesAreInOrderAlongTheirEdge) {
  EdgeMapParams params;
  for (const EdgePiece& piece : depths_of(12, kAround, params)) {
    EXPECT_GE(int(piece.size()), params.min_vertices);
    for (size_t i = 1; i < piece.size(); ++i)
      EXPECT_LE(piece[i].edge_pixel - piece[i - 1].edge_pixel, params.step_px);
    for (const EdgeNode& n : piece) EXPECT_LE(n.idepth_sigma, params.max_relative_sigma * n.idepth);
  }
}

TEST(EdgeDepth, ASingleImageGivesNoDepth) {
  EXPECT_TRUE(depths_of(12, {}, EdgeMapParams()).empty());
  EXPECT_TRUE(depths_of(12, {12, 12, 12, 12}, EdgeMapParams()).empty());  // no baseline
}

// Share of the edge pixels whose depth, times `factor`, is likelier than elsewhere along the ray, or than
// times `own` unless that is 0, and share of those of which views say nothing.
std::pair<double, double> likely_share(const std::vector<int>& frames, double factor, double own = 0) {
  std::vector<EdgeView> views;
  for (const int f : frames) views.push_back(view_of(12, f));
  const ViewSet set(Sweep::pinhole(), views);
  const PyramidLevel& level = Sweep::pyramid(12)->finest();
  const std::vector<EdgeSides> sides = sample_sides(level);
  int all = 0, likely = 0, silent = 0;
  for (size_t i = 0; i < level.edges.pixels.size(); i += 50, ++all) {
    const EdgePixel& e = level.edges.pixels[i];
    EdgeSight sight;
    sight.px = e.position().cast<double>(), sight.normal = e.normal().cast<double>(), sight.sides = sides[i];
    look_along(set, sight.px, sight.normal, &sight.lines);
    const double truth = Sweep::idepth(12, sight.px);
    const double ratio = log_likelihood_ratio(sight, set, factor * truth, own * truth, 10, EdgeMapParams());
    likely += ratio > 0, silent += ratio == 0;
  }
  return {double(likely) / all, double(silent) / all};
}

TEST(EdgeDepth, ViewsSayWhereAnEdgeIsOnlyWhereDepthMovesIt) {
  const double right = likely_share(kAround, 1).first, wrong = likely_share(kAround, 1.4).first;
  std::cout << "[ figures  ] likely at the true depth " << right << ", at another " << wrong << std::endl;
  EXPECT_GT(right, 0.6);
  EXPECT_LT(wrong, 0.5 * right);
  EXPECT_EQ(likely_share({12, 12, 12}, 1).second, 1);  // no baseline
}

TEST(EdgeDepth, ADepthIsContestedByTheOneAnEdgeHas) {
  EXPECT_GT(likely_share(kAround, 1, 1.4).first, 0.6);
  EXPECT_LT(likely_share(kAround, 1.4, 1).first, 0.1);
}

TEST(EdgeDepth, OneViewThatShowsAnEdgeOutweighsThreeThatDoNot) {
  EXPECT_GT(log_odds_of_edge(1, 3), 0);
  EXPECT_LT(log_odds_of_edge(1, 4), 0);
  EXPECT_EQ(log_odds_of_edge(0, 0), 0);
}

TEST(EdgeDepth, NothingIsNearerThanAllowed) {
  for (const EdgePiece& piece : depths_of(12, kAround, EdgeMapParams(), 0.2))
    for (const EdgeNode& n : piece) EXPECT_LE(n.idepth, 0.2 * 1.05);
}

// A change of exposure is a gain, which is removed before the sides of edges are compared.
TEST(EdgeDepth, ADarkerImageIsAsGood) {
  EdgeMapParams params;
  params.max_relative_sigma = 0.02;
  std::vector<EdgeView> views;
  for (const int f : kAround) {
    const auto dark = Sweep::scene().pyramid(test::sweep_pose(f), 0.5, 0.0, 1.0, uint64_t(f + 1));
    views.push_back({dark, std::make_shared<const std::vector<EdgeSides>>(sample_sides(dark->finest())),
                     test::sweep_pose(f).inverse() * test::sweep_pose(12), 0.5});
  }
  const auto host = Sweep::pyramid(12);
  const auto find = [&] {
    return figures_of(
        12, find_edge_depths(Sweep::pinhole(), *host, sample_sides(host->finest()), views, 2, params));
  };
  const Figures f = find();
  const Figures as_bright = figures_of(12, depths_of(12, kAround, params));
  EXPECT_GT(f.nodes, 0.8 * as_bright.nodes);
  for (EdgeView& v : views) v.gain = 1;  // the gain is unknown
  EXPECT_LT(find().nodes, f.nodes);
}

}  // namespace
}  // namespace edgevo
