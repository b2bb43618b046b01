// SPDX-License-Identifier: BSD-3-Clause
// Epipolar search on images with exact depth: what it finds, and what it reports if it finds nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edgevo/alignment/projection.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/mapping/depth_filter.h"
#include "support/plane_scene.h"

namespace edgevo {
namespace {

using test::PlaneScene;

struct Errors {
  int searched = 0;
  std::vector<double> px;      // along the epipolar line
  std::vector<double> sigmas;  // errors in reported sigmas
};

// Searches every 7th edge pixel of the host over half to twice its true inverse depth.
Errors search_all(const PlaneScene& scene, const FramePyramid& host, const FramePyramid& target,
                  const SE3& T_target_host, const DepthFilterParams& params) {
  Errors errors;
  const auto& pixels = host.finest().edges.pixels;
  for (size_t i = 0; i < pixels.size(); i += 7) {
    const Eigen::Vector2d px = pixels[i].position().cast<double>();
    const double truth = scene.idepth(SE3(), px);
    const auto image = [&](double q) {
      return project(scene.camera.pinhole(), T_target_host.R(), T_target_host.translation(),
                     scene.camera.pinhole().ray(px), q)
          .px;
    };
    if (!scene.camera.pinhole().contains(image(truth), 10)) continue;
    ++errors.searched;
    const EpipolarMatch m = search_epipolar(host, target, px, pixels[i].normal().cast<double>(),
                                            T_target_host, {0.5 * truth, 2 * truth}, params);
    if (m.outcome != EpipolarOutcome::kFound) continue;
    const double px_per_idepth = (image(1.01 * truth) - image(0.99 * truth)).norm() / (0.02 * truth);
    errors.px.push_back((m.idepth - truth) * px_per_idepth);
    errors.sigmas.push_back((m.idepth - truth) / m.idepth_sigma);
  }
  return errors;
}

struct Motion {
  const char* name;
  Eigen::Vector3d position;
  double turn_rad;
};

class EpipolarSearchMotions : public ::testing::TestWithParam<Motion> {
 protected:
  SE3 T_world_target() const {
    return {
        Eigen::Quaterniond(Eigen::AngleAxisd(GetParam().turn_rad, Eigen::Vector3d(0.2, 1, 0.1).normalized())),
        GetParam().position};
  }
};

TEST_P(EpipolarSearchMotions, FindsTheTrueDepth) {
  const PlaneScene scene;
  const auto host = scene.pyramid(SE3()), target = scene.pyramid(T_world_target());
  const Errors e = search_all(scene, *host, *target, T_world_target().inverse(), DepthFilterParams());
  ASSERT_GT(e.searched, 300);
  EXPECT_GT(e.px.size(), 0.4 * e.searched);
  // Without image noise only rounding to gray levels and the change of the patch's shape are left: a tenth of
  // a pixel.
  EXPECT_LT(std::abs(median(e.px)), 0.03);
  std::vector<double> errors;
  int outliers = 0;
  for (size_t i = 0; i < e.px.size(); ++i) {
    errors.push_back(std::abs(e.px[i]));
    outliers += std::abs(e.sigmas[i]) > 3;
  }
  EXPECT_LT(1.4826 * median(errors), 0.15);
  EXPECT_LT(outliers, 0.04 * double(e.px.size()));
}

INSTANTIATE_TEST_SUITE_P(Search, EpipolarSearchMotions,
                         ::testing::Values(Motion{"sideways", {0.25, 0.02, 0}, 0.0},
                                           Motion{"upwards", {0, -0.25, 0.02}, 0.0},
                                           Motion{"turning", {0.2, 0.1, 0.05}, 0.04},
                                           Motion{"forward", {0.02, 0.02, 0.5}, 0.0}),
                         [](const auto& info) { return std::string(info.param.name); });

// The reported sigma covers the true error under sensor noise: it is a bound, since edges also move for other
// reasons.
TEST(EpipolarSearch, ReportsASigmaThatCoversTheError) {
  const PlaneScene scene;
  const SE3 T_world_target(Eigen::Matrix3d::Identity(), {0.25, 0.05, 0});
  PyramidBuilder builder(scene.camera, EdgeParams());
  const auto noisy = [&](const SE3& T_world_cam, uint64_t seed) {
    GrayImage image = scene.render(T_world_cam);
    Random random(seed);
    for (uint8_t& p : image.pixels) p = uint8_t(std::clamp(p + 3.0 * random.normal(), 0.0, 255.0));
    return builder.build(image);
  };
  const auto host = noisy(SE3(), 1), target = noisy(T_world_target, 2);
  const Errors e = search_all(scene, *host, *target, T_world_target.inverse(), DepthFilterParams());
  ASSERT_GT(e.sigmas.size(), 150u);
  std::vector<double> errors;
  for (double s : e.sigmas) errors.push_back(std::abs(s));
  EXPECT_LT(1.4826 * median(errors), 1);
  EXPECT_LT(std::abs(median(e.px)), 0.05);
}

TEST(EpipolarSearch, ASecondCameraUnderAnotherExposureFindsTheSame) {
  const PlaneScene scene;
  const SE3 T_world_target(Eigen::Matrix3d::Identity(), {0.25, 0.02, 0});
  const auto host = scene.pyramid(SE3()), target = scene.pyramid(T_world_target, 0.6, 20);
  const Errors e = search_all(scene, *host, *target, T_world_target.inverse(), DepthFilterParams());
  EXPECT_GT(e.px.size(), 0.4 * e.searched);
  EXPECT_LT(std::abs(median(e.px)), 0.05);
}

// ---- outcomes without a depth ----

class EpipolarOutcomes : public ::testing::Test {
 protected:
  std::shared_ptr<const FramePyramid> build(const GrayImage& image) const {
    return PyramidBuilder(scene.camera, EdgeParams()).build(image);
  }
  // Number of edge pixels of the host's middle that end in each outcome.
  int count(EpipolarOutcome outcome, const FramePyramid& host, const FramePyramid& target,
            const SE3& T_target_host, const IdepthRange& range, int* all) const {
    int n = 0;
    *all = 0;
    for (const EdgePixel& e : host.finest().edges.pixels) {
      if (!scene.camera.pinhole().contains(e.position().cast<double>(), 60)) continue;
      ++*all;
      n += search_epipolar(host, target, e.position().cast<double>(), e.normal().cast<double>(),
                           T_target_host, range, DepthFilterParams())
               .outcome == outcome;
    }
    return n;
  }
  void expect_all(EpipolarOutcome outcome, const FramePyramid& host, const FramePyramid& target,
                  const SE3& T_target_host, double share = 1.0, const IdepthRange& range = {0.1, 0.4}) const {
    int all = 0;
    const int n = count(outcome, host, target, T_target_host, range, &all);
    ASSERT_GT(all, 100);
    EXPECT_GE(n, share * all) << n << " of " << all;
  }
  static SE3 sideways(double t) { return {Eigen::Matrix3d::Identity(), Eigen::Vector3d(t, 0, 0)}; }

  PlaneScene scene;
};

TEST_F(EpipolarOutcomes, NoBaselineAtAStandstillAndInPureRotation) {
  const auto host = scene.pyramid(SE3());
  expect_all(EpipolarOutcome::kNoBaseline, *host, *host, SE3());
  const SE3 turn(Eigen::Quaterniond(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitY())),
                 Eigen::Vector3d::Zero());
  expect_all(EpipolarOutcome::kNoBaseline, *host, *scene.pyramid(turn.inverse()), turn);
}

TEST_F(EpipolarOutcomes, OutOfViewWhereTheCameraLooksAway) {
  const auto host = scene.pyramid(SE3());
  for (double angle : {1.4, -1.4, 3.0}) {
    const SE3 away(Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY())),
                   Eigen::Vector3d(0.3, 0, 0));
    expect_all(EpipolarOutcome::kOutOfView, *host, *host, away);
  }
}

TEST_F(EpipolarOutcomes, NoMatchInABlankImage) {
  const auto blank = build(test::make_image(320, 240, [](double, double) { return 90; }));
  int all = 0;
  const auto count_of = [&](EpipolarOutcome outcome) {
    return count(outcome, *scene.pyramid(SE3()), *blank, sideways(-0.3), {0.1, 0.4}, &all);
  };
  const int no_match = count_of(EpipolarOutcome::kNoMatch), along = count_of(EpipolarOutcome::kAlongLine);
  EXPECT_GT(no_match, 1000);
  EXPECT_EQ(no_match + along, all);
}

TEST_F(EpipolarOutcomes, NoMatchOnEdgesOfTheOtherPolarity) {
  const auto step = [&](double dark, double bright) {
    return build(test::slanted_step(320, 240, {160, 120}, Eigen::Vector2d::UnitX(), dark, bright));
  };
  expect_all(EpipolarOutcome::kNoMatch, *step(60, 180), *step(180, 60), sideways(-0.3));
}

TEST_F(EpipolarOutcomes, EdgesAlongTheEpipolarLineAreNotSearched) {
  const auto level = build(test::slanted_step(320, 240, {160, 120}, Eigen::Vector2d::UnitY(), 60, 180));
  expect_all(EpipolarOutcome::kAlongLine, *level, *level, sideways(-0.3));
}

TEST_F(EpipolarOutcomes, AmbiguousAmongEqualStripes) {
  const auto stripes = build(test::make_image(
      320, 240, [](double x, double) { return 128 + 90 * std::tanh(4 * std::sin(x * M_PI / 20)); }));
  // 0.6 x 260 px x (0.1 ... 0.6): 16 to 94 pixels to the left, where there are stripes at 40 and 80; near the
  // left border the second one lies outside.
  expect_all(EpipolarOutcome::kAmbiguous, *stripes, *stripes, sideways(-0.6), 0.8, {0.1, 0.6});
}

TEST_F(EpipolarOutcomes, OneStripeInRangeIsNotAmbiguous) {
  const auto step = build(test::slanted_step(320, 240, {160, 120}, Eigen::Vector2d::UnitX(), 60, 180));
  const auto moved = build(test::slanted_step(320, 240, {140, 120}, Eigen::Vector2d::UnitX(), 60, 180));
  expect_all(EpipolarOutcome::kFound, *step, *moved, sideways(-0.3), 0.95, {0.1, 0.6});
}

// No query of the odometry makes it fail or return numbers that are not finite.
TEST_F(EpipolarOutcomes, AnyMotionGivesFiniteNumbers) {
  const auto host = scene.pyramid(SE3());
  Random random(2);
  int found = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    Vector6d xi;
    for (int i = 0; i < 6; ++i) xi[i] = (i < 3 ? 3 : 1) * random.normal() * random.uniform();
    const auto& pixels = host->finest().edges.pixels;
    const EdgePixel& e = pixels[size_t(random.below(int(pixels.size())))];
    const double low = random.uniform(1e-4, 1);
    const EpipolarMatch m =
        search_epipolar(*host, *host, e.position().cast<double>(), e.normal().cast<double>(), SE3::exp(xi),
                        {low, low * random.uniform(1, 100)}, DepthFilterParams());
    if (m.outcome != EpipolarOutcome::kFound) continue;
    ++found;
    EXPECT_TRUE(std::isfinite(m.idepth) && m.idepth > 0);
    EXPECT_TRUE(std::isfinite(m.idepth_sigma) && m.idepth_sigma > 0);
    EXPECT_TRUE(scene.camera.pinhole().contains(m.px, -5));
  }
  EXPECT_GT(found, 0);
}

// ---- over several frames ----

TEST(UpdateDepths, SigmaShrinksAndDepthConverges) {
  const PlaneScene scene;
  Keyframe host;
  host.pyramid = scene.pyramid(SE3());
  const DepthFilterParams params;
  Random random(1);
  const CellGrid grid(320, 240, params.cell_px);
  host.immature = make_immature_points(
      host, grid, std::vector<bool>(size_t(grid.size()), false),
      [&](const Eigen::Vector2d& px) {
        const double q = scene.idepth(SE3(), px);
        return IdepthRange{0.4 * q, 2.5 * q};
      },
      params, &random);
  const auto error = [&](std::vector<double>* sigma) {
    std::vector<double> relative;
    sigma->clear();
    for (const ImmaturePoint& p : host.immature) {
      if (p.dead || p.good == 0) continue;
      const double truth = scene.idepth(SE3(), p.px);
      relative.push_back(std::abs(p.idepth / truth - 1));
      sigma->push_back(p.idepth_sigma / truth);
    }
    return relative;
  };
  std::vector<double> sigma_early, sigma_late, early;
  for (int k = 1; k <= 6; ++k) {
    const SE3 T_world_target(Eigen::Matrix3d::Identity(), {0.06 * k, 0.02 * k, 0});
    update_depths(*scene.pyramid(T_world_target), T_world_target.inverse(), params, &host);
    if (k == 2) early = error(&sigma_early);
  }
  const std::vector<double> late = error(&sigma_late);
  ASSERT_GT(late.size(), host.immature.size() / 2);
  EXPECT_LT(median(sigma_late), 0.5 * median(sigma_early));
  EXPECT_LT(median(late), median(early));
  EXPECT_LT(median(late), 0.005);
}

}  // namespace
}  // namespace edgevo
