// SPDX-License-Identifier: BSD-3-Clause
// Depth filter: triangulation, fusion, smoothing, and new immature points.
#include "edgevo/mapping/depth_filter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "edgevo/alignment/projection.h"
#include "support/plane_scene.h"

namespace edgevo {
namespace {

// ---- triangulation ----

TEST(Triangulation, IsExactForAnyMotionAndDepth) {
  const Pinhole camera{260, 250, 159.5, 119.5, 320, 240};
  Random random(4);
  int checked = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Vector6d xi;
    for (int i = 0; i < 6; ++i) xi[i] = (i < 3 ? 0.5 : 0.1) * random.normal();
    const SE3 T = SE3::exp(xi);
    const double truth = random.uniform(0.05, 0.5);
    const Eigen::Vector3d ray(random.uniform(-0.5, 0.5), random.uniform(-0.4, 0.4), 1), rotated = T.R() * ray;
    const auto px = [&](double idepth) { return project(camera, T.R(), T.translation(), ray, idepth).px; };
    const Eigen::Vector2d motion = px(1.001 * truth) - px(0.999 * truth);
    if (motion.norm() < 1e-4) continue;
    ++checked;
    EXPECT_NEAR(triangulate_idepth(camera, rotated, T.translation(), px(truth), motion.normalized()), truth,
                1e-8 * truth);
  }
  EXPECT_GT(checked, 190);
}

TEST(Triangulation, IsNotFiniteWithoutBaseline) {
  const Pinhole camera{260, 250, 159.5, 119.5, 320, 240};
  const Eigen::Vector3d ray(0.1, 0.2, 1);
  EXPECT_FALSE(std::isfinite(triangulate_idepth(camera, ray, Eigen::Vector3d::Zero(), camera.project(ray),
                                                Eigen::Vector2d::UnitX())));
}

// ---- fusion ----

EpipolarMatch found(double idepth, double sigma) {
  EpipolarMatch m;
  m.outcome = EpipolarOutcome::kFound;
  m.idepth = idepth;
  m.idepth_sigma = sigma;
  return m;
}

EpipolarMatch not_found(EpipolarOutcome outcome) {
  EpipolarMatch m;
  m.outcome = outcome;
  return m;
}

ImmaturePoint point(double idepth, double sigma, int good = 0) {
  ImmaturePoint p;
  p.idepth = idepth;
  p.idepth_sigma = sigma;
  p.good = good;
  return p;
}

TEST(FuseDepth, TheFirstDepthReplacesTheRange) {
  ImmaturePoint p = point(0.3, 0.1);
  fuse(found(0.2, 0.01), &p);
  EXPECT_EQ(p.idepth, 0.2);
  EXPECT_EQ(p.idepth_sigma, 0.01);
  EXPECT_EQ(p.good, 1);
}

TEST(FuseDepth, LaterDepthsAreTheProductOfGaussians) {
  ImmaturePoint p = point(0.2, 0.03, 1);
  fuse(found(0.23, 0.02), &p);
  const double a = 1 / (0.03 * 0.03), b = 1 / (0.02 * 0.02);
  EXPECT_NEAR(p.idepth, (0.2 * a + 0.23 * b) / (a + b), 1e-12);
  EXPECT_NEAR(p.idepth_sigma, std::sqrt(1 / (a + b)), 1e-12);
  EXPECT_EQ(p.good, 2);
  EXPECT_EQ(p.bad, 0);
}

TEST(FuseDepth, MeasurementsOfOneDepthConverge) {
  Random random(9);
  constexpr double kTruth = 0.25, kSigma = 0.02;
  double chi_square = 0;
  constexpr int kTrials = 300;
  for (int trial = 0; trial < kTrials; ++trial) {
    ImmaturePoint p = point(0.3, 0.2);
    for (int i = 0; i < 9; ++i) fuse(found(kTruth + kSigma * random.normal(), kSigma), &p);
    EXPECT_NEAR(p.idepth_sigma, kSigma / std::sqrt(double(p.good)), 1e-12);
    chi_square += std::pow((p.idepth - kTruth) / p.idepth_sigma, 2) / kTrials;
  }
  EXPECT_NEAR(chi_square, 1,
              4 * std::sqrt(2.0 / kTrials));  // four sigmas of a chi-square of that many trials
}

TEST(FuseDepth, ADisagreeingDepthIsAnOutlierAndChangesNothing) {
  ImmaturePoint p = point(0.2, 0.01, 2);
  fuse(found(0.3, 0.01), &p);
  EXPECT_EQ(p.idepth, 0.2);
  EXPECT_EQ(p.idepth_sigma, 0.01);
  EXPECT_EQ(p.good, 2);
  EXPECT_EQ(p.bad, 1);
  EXPECT_FALSE(p.dead);
}

TEST(FuseDepth, AmbiguousAndUnmatchedSearchesAreOutliersUnseenOnesAreNot) {
  ImmaturePoint p = point(0.2, 0.1);
  fuse(not_found(EpipolarOutcome::kOutOfView), &p);
  fuse(not_found(EpipolarOutcome::kNoBaseline), &p);
  fuse(not_found(EpipolarOutcome::kAlongLine), &p);
  EXPECT_EQ(p.bad, 0);
  fuse(not_found(EpipolarOutcome::kAmbiguous), &p);
  fuse(not_found(EpipolarOutcome::kNoMatch), &p);
  EXPECT_EQ(p.bad, 2);
}

TEST(FuseDepth, KillsPointsWithMoreOutliersThanTwoPlusAgreements) {
  for (int good = 0; good < 3; ++good) {
    ImmaturePoint p = point(0.2, 0.1, good);
    for (int i = 0; i < 2 + good; ++i) fuse(not_found(EpipolarOutcome::kNoMatch), &p);
    EXPECT_FALSE(p.dead) << good;
    fuse(not_found(EpipolarOutcome::kNoMatch), &p);
    EXPECT_TRUE(p.dead) << good;
  }
}

// ---- smoothing ----

// Two straight vertical edges, at x = 20 and x = 24, of 40 pixels each.
ImageEdges two_edges() {
  ImageEdges map;
  map.width = 60, map.height = 60;
  for (int chain = 0; chain < 2; ++chain) {
    const int begin = int(map.pixels.size());
    for (int y = 10; y < 50; ++y) map.pixels.push_back({20.0f + 4 * chain, float(y), 1, 0, 10, chain});
    map.chains.push_back({begin, int(map.pixels.size())});
  }
  return map;
}

ImmaturePoint on_edge(const ImageEdges& edges, int edge_pixel, double idepth, double sigma) {
  ImmaturePoint p = point(idepth, sigma, 1);
  p.edge_pixel = edge_pixel;
  p.px = edges.pixels[size_t(edge_pixel)].position().cast<double>();
  p.normal = edges.pixels[size_t(edge_pixel)].normal().cast<double>();
  return p;
}

DepthFilterParams smoothing(double weight) {
  DepthFilterParams params;
  params.smoothing_weight = weight;
  return params;
}

TEST(SmoothDepths, PullsByTheWeightTowardsTheNeighbours) {
  const ImageEdges edges = two_edges();
  std::vector<ImmaturePoint> p = {on_edge(edges, 0, 0.20, 0.01), on_edge(edges, 8, 0.21, 0.01),
                                  on_edge(edges, 16, 0.206, 0.02)};
  smooth_along_edges(edges, smoothing(0.3), &p);
  EXPECT_NEAR(p[0].idepth, 0.7 * 0.20 + 0.3 * 0.21, 1e-12);
  const double mean =
      (0.20 / 1e-4 + 0.206 / 4e-4) / (1 / 1e-4 + 1 / 4e-4);  // of both neighbours, by their variances
  EXPECT_NEAR(p[1].idepth, 0.7 * 0.21 + 0.3 * mean, 1e-12);
  EXPECT_NEAR(p[2].idepth, 0.7 * 0.206 + 0.3 * 0.21, 1e-12);
}

// The second of two points must not pull the first.
void expect_no_pull(const ImageEdges& edges, const ImmaturePoint& a, const ImmaturePoint& b,
                    double weight = 0.3) {
  std::vector<ImmaturePoint> p = {a, b};
  smooth_along_edges(edges, smoothing(weight), &p);
  EXPECT_EQ(p[0].idepth, a.idepth);
  EXPECT_EQ(p[1].idepth, b.idepth);
}

TEST(SmoothDepths, DoesNotPullAcrossEdges) {
  const ImageEdges edges = two_edges();
  expect_no_pull(edges, on_edge(edges, 39, 0.20, 0.01), on_edge(edges, 79, 0.21, 0.01));
}

TEST(SmoothDepths, DoesNotPullBeyondItsReach) {
  const ImageEdges edges = two_edges();
  expect_no_pull(edges, on_edge(edges, 0, 0.20, 0.01), on_edge(edges, 15, 0.21, 0.01));
}

TEST(SmoothDepths, DoesNotPullWhatDisagrees) {
  const ImageEdges edges = two_edges();
  expect_no_pull(edges, on_edge(edges, 0, 0.20, 0.01), on_edge(edges, 8, 0.24, 0.01));
}

TEST(SmoothDepths, DeadAndUnmeasuredPointsNeitherPullNorMove) {
  const ImageEdges edges = two_edges();
  const ImmaturePoint alive = on_edge(edges, 0, 0.20, 0.01);
  ImmaturePoint dead = on_edge(edges, 8, 0.21, 0.01), unmeasured = dead;
  dead.dead = true;
  unmeasured.good = 0;
  expect_no_pull(edges, alive, dead);
  expect_no_pull(edges, alive, unmeasured);
}

TEST(SmoothDepths, OffWithZeroWeight) {
  const ImageEdges edges = two_edges();
  expect_no_pull(edges, on_edge(edges, 0, 0.20, 0.01), on_edge(edges, 8, 0.21, 0.01), 0.0);
}

// ---- immature points ----

class ImmaturePoints : public ::testing::Test {
 protected:
  ImmaturePoints() : grid(320, 240, params.cell_px), occupied(size_t(grid.size()), false) {
    keyframe.pyramid = test::PlaneScene().pyramid(SE3());
  }
  std::vector<ImmaturePoint> make(uint64_t seed) const {
    Random random(seed);
    const auto range = [](const Eigen::Vector2d& px) {
      return IdepthRange{0.1 + 1e-4 * px.x(), 0.4 + 1e-4 * px.y()};
    };
    return make_immature_points(keyframe, grid, occupied, range, params, &random);
  }

  DepthFilterParams params;
  Keyframe keyframe;
  CellGrid grid;
  std::vector<bool> occupied;
};

TEST_F(ImmaturePoints, OnePerCellOnEdgesInOrder) {
  const auto points = make(1);
  ASSERT_GT(points.size(), 200u);
  std::set<int> cells;
  int previous = -1;
  const ImageEdges& edges = keyframe.pyramid->finest().edges;
  for (const ImmaturePoint& p : points) {
    EXPECT_TRUE(cells.insert(grid.index(p.px.x(), p.px.y())).second);
    EXPECT_GT(p.edge_pixel, previous);
    previous = p.edge_pixel;
    EXPECT_EQ(p.px, edges.pixels[size_t(p.edge_pixel)].position().cast<double>());
    EXPECT_EQ(p.normal, edges.pixels[size_t(p.edge_pixel)].normal().cast<double>());
    EXPECT_EQ(p.good + p.bad + p.age, 0);
    EXPECT_FALSE(p.dead);
  }
}

TEST_F(ImmaturePoints, EveryFreeCellWithAnEdgeGetsOneAndNoOccupiedCell) {
  std::set<int> with_edge;
  for (const EdgePixel& e : keyframe.pyramid->finest().edges.pixels) with_edge.insert(grid.index(e.x, e.y));
  EXPECT_EQ(make(1).size(), with_edge.size());
  size_t free = 0;
  for (int c = 0; c < grid.size(); ++c) {
    occupied[size_t(c)] = c % 3 == 0;
    free += c % 3 != 0 && with_edge.count(c) > 0;
  }
  const auto points = make(1);
  EXPECT_EQ(points.size(), free);
  for (const ImmaturePoint& p : points) EXPECT_NE(grid.index(p.px.x(), p.px.y()) % 3, 0);
}

TEST_F(ImmaturePoints, TheSearchOfTwoSigmaCoversTheRange) {
  for (const ImmaturePoint& p : make(1)) {
    EXPECT_NEAR(p.idepth - 2 * p.idepth_sigma, 0.1 + 1e-4 * p.px.x(), 1e-12);
    EXPECT_NEAR(p.idepth + 2 * p.idepth_sigma, 0.4 + 1e-4 * p.px.y(), 1e-12);
  }
}

TEST_F(ImmaturePoints, TheSeedDecides) {
  const auto edge_pixels = [this](uint64_t seed) {
    std::vector<int> out;
    for (const ImmaturePoint& p : make(seed)) out.push_back(p.edge_pixel);
    return out;
  };
  EXPECT_EQ(edge_pixels(1), edge_pixels(1));
  EXPECT_NE(edge_pixels(1), edge_pixels(2));
}

TEST_F(ImmaturePoints, TheLimitHoldsAndIsSpreadOverTheImage) {
  params.max_new_points = 80;
  const auto points = make(1);
  ASSERT_EQ(points.size(), 80u);
  int upper = 0, left = 0;
  for (const ImmaturePoint& p : points) upper += p.px.y() < 120, left += p.px.x() < 160;
  // A fair selection puts half on each side, give or take four sigmas of a binomial.
  EXPECT_NEAR(upper, 40, 4 * std::sqrt(80 * 0.25));
  EXPECT_NEAR(left, 40, 4 * std::sqrt(80 * 0.25));
}

TEST_F(ImmaturePoints, NoneInABlankImage) {
  const test::PlaneScene scene;
  keyframe.pyramid =
      PyramidBuilder(scene.camera, EdgeParams()).build(test::make_image(320, 240, [](double, double) {
        return 90;
      }));
  EXPECT_TRUE(make(1).empty());
}

}  // namespace
}  // namespace edgevo
