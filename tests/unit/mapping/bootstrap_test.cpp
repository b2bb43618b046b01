// SPDX-License-Identifier: BSD-3-Clause
// Two-view bootstrap: what it recovers, and what it reports if it cannot.
#include "edgevo/mapping/bootstrap.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "support/sweep_scene.h"

namespace edgevo {
namespace {

using test::HollowScene;
using test::sweep_pose;
using ::testing::HasSubstr;

constexpr double kDegree = M_PI / 180;
// The essential matrix comes from five corners and is not adjusted: a rotation may be confused with a
// translation by this share of the parallax, and hence of the baseline. The bundle adjustment of the first
// map corrects that.
constexpr double kRotationShare = 0.35;

Timestamp time_of(int frame) { return Timestamp::from_seconds(0.1 * frame); }

class BootstrapOnSweep : public ::testing::Test {
 protected:
  // The images are small, hence the required motion is larger than the default: otherwise a tenth of a pixel
  // would matter too much.
  BootstrapOnSweep() { params.min_disparity = 0.06, params.min_parallax_deg = 2; }

  Bootstrap make(uint64_t seed = 1, TurnBetween turn = {}) const {
    return {scene.camera.pinhole(), params, seed, std::move(turn)};
  }
  // Frame k of the sweep, with a gain on its gray levels.
  BootstrapStatus add(Bootstrap* bootstrap, int k, double gain = 1) const {
    return bootstrap->add(k, time_of(k),
                          gain == 1 ? test::Sweep::pyramid(k) : scene.pyramid(sweep_pose(k), gain));
  }
  // Adds frames from `first` on until there is a result; fails after 40.
  BootstrapResult run(Bootstrap* bootstrap, int first = 0, bool flicker = false) const {
    for (int k = first; k < first + 40; ++k) {
      BootstrapStatus status = add(bootstrap, k, flicker && k % 2 ? 0.6 : 1.0);
      if (status.result) {
        EXPECT_EQ(to_string(status.reasons), "");
        return *status.result;
      }
      EXPECT_NE(to_string(status.reasons), "");
    }
    ADD_FAILURE() << "no result in 40 frames";
    return {};
  }
  SE3 truth(const BootstrapResult& r, const BootstrapView& view) const {
    return sweep_pose(view.frame_index).inverse() * sweep_pose(r.views.front().frame_index);
  }
  // Unit of the result over that of the scene, from its depths.
  double scale(const BootstrapResult& r) const {
    std::vector<double> ratio;
    for (const BootstrapCorner& c : r.corners)
      ratio.push_back(scene.idepth(sweep_pose(r.views.front().frame_index), c.px_first) / c.idepth_first);
    return median(ratio);
  }

  HollowScene scene;
  BootstrapParams params;
};

void expect_direction(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double degrees) {
  EXPECT_LT(std::atan2(a.cross(b).norm(), a.dot(b)), degrees * kDegree)
      << a.transpose() << " against " << b.transpose();
}

// A gyro that is right to a fiftieth of a degree.
std::optional<CameraTurn> turn_by_gyro(Timestamp begin, Timestamp end) {
  const auto at = [](Timestamp t) { return sweep_pose(10 * t.seconds()); };
  CameraTurn turn;
  turn.R = (at(end).inverse() * at(begin)).rotation();
  turn.covariance = std::pow(0.02 * kDegree, 2) * Eigen::Matrix3d::Identity();
  return turn;
}

// Over so little parallax corners alone confuse the turn with the translation.
TEST_F(BootstrapOnSweep, WithAKnownTurnTheMotionIsThatOfLittleParallax) {
  params.min_disparity = 0.02, params.min_parallax_deg = 0.7;
  double with = 0, without = 0;
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    Bootstrap known = make(seed, turn_by_gyro), unknown = make(seed);
    const BootstrapResult a = run(&known, 3 * int(seed)), b = run(&unknown, 3 * int(seed));
    const auto error = [&](const BootstrapResult& r) {
      return (r.views.back().T_cam_first * truth(r, r.views.back()).inverse()).angle();
    };
    with += error(a), without += error(b);
    expect_direction(a.views.back().T_cam_first.translation(), truth(a, a.views.back()).translation(), 5);
  }
  EXPECT_LT(with, 3 * 0.1 * kDegree);
  EXPECT_LT(with, 0.5 * without);
}

TEST_F(BootstrapOnSweep, RecoversTheMotionUpToScale) {
  Bootstrap bootstrap = make();
  const BootstrapResult r = run(&bootstrap);
  ASSERT_GE(r.views.size(), 2u);
  const SE3& T = r.views.back().T_cam_first;
  const SE3 T_truth = truth(r, r.views.back());
  EXPECT_LT((T * T_truth.inverse()).angle(), kRotationShare * r.parallax_deg * kDegree);
  expect_direction(T.translation(), T_truth.translation(), 5);
  EXPECT_NEAR(T.translation().norm() / T_truth.translation().norm() / scale(r), 1, kRotationShare);
}

TEST_F(BootstrapOnSweep, SaysByWhichModelItMovedAndHowWellThatFits) {
  Bootstrap bootstrap = make();
  const BootstrapResult r = run(&bootstrap);
  EXPECT_THAT(r.why, ::testing::ContainsRegex("motion by (essential matrix|plane|frame before), [0-9.]+ px"));
  EXPECT_THAT(r.why, HasSubstr("parallax"));
}

TEST_F(BootstrapOnSweep, RecoversDepthsUpToScale) {
  Bootstrap bootstrap = make();
  const BootstrapResult r = run(&bootstrap);
  ASSERT_GE(int(r.corners.size()), kMinBootstrapCorners / 2);
  const double unit = scale(r);
  std::vector<double> error_first, error_last, depth;
  for (const BootstrapCorner& c : r.corners) {
    depth.push_back(1 / c.idepth_first);
    error_first.push_back(std::abs(
        c.idepth_first * unit / scene.idepth(sweep_pose(r.views.front().frame_index), c.px_first) - 1));
    error_last.push_back(
        std::abs(c.idepth_last * unit / scene.idepth(sweep_pose(r.views.back().frame_index), c.px_last) - 1));
  }
  EXPECT_NEAR(median(depth), kFirstMedianDepth, 1e-9);
  EXPECT_LT(median(error_first), 0.06);
  EXPECT_LT(median(error_last), 0.06);
  EXPECT_GE(r.parallax_deg, params.min_parallax_deg);
}

TEST_F(BootstrapOnSweep, PlacesEveryViewInBetween) {
  Bootstrap bootstrap = make();
  const BootstrapResult r = run(&bootstrap);
  ASSERT_GE(r.views.size(), 3u);
  EXPECT_LT((r.views.front().T_cam_first.log()).norm(), 1e-12);
  const double unit = scale(r), baseline = truth(r, r.views.back()).translation().norm();
  for (const BootstrapView& v : r.views) {
    EXPECT_TRUE(v.placed);
    EXPECT_EQ(v.time, time_of(v.frame_index));
    EXPECT_LT((v.T_cam_first * truth(r, v).inverse()).angle(), kRotationShare * r.parallax_deg * kDegree);
    EXPECT_LT((v.T_cam_first.translation() / unit - truth(r, v).translation()).norm(),
              kRotationShare * baseline)
        << v.frame_index;
  }
}

TEST_F(BootstrapOnSweep, AFlickeringExposureDoesNoHarm) {
  Bootstrap bootstrap = make();
  const BootstrapResult r = run(&bootstrap, 0, true);
  const SE3 T_truth = truth(r, r.views.back());
  EXPECT_LT((r.views.back().T_cam_first * T_truth.inverse()).angle(),
            kRotationShare * r.parallax_deg * kDegree);
  expect_direction(r.views.back().T_cam_first.translation(), T_truth.translation(), 8);
}

// As the predicted motion straightens them while an older map is still tracked.
TEST_F(BootstrapOnSweep, RowsThatAreStraightAlreadyStayAsTheyAre) {
  ImageMotion turn;
  turn.velocity << 0, 0, 0, 0, 1, 0;
  Bootstrap global = make();
  Bootstrap rolling = make();
  BootstrapStatus by_global, by_rolling;
  for (int k = 0; k < 40 && !by_global.result; ++k) {
    by_global = global.add(k, time_of(k), scene.pyramid(sweep_pose(k)));
    const auto rolled = std::const_pointer_cast<FramePyramid>(scene.pyramid(sweep_pose(k)));
    rolled->correction.readout_s = 0.05;
    by_rolling = rolling.add(k, time_of(k), rolled, true, turn);
  }
  ASSERT_TRUE(by_global.result && by_rolling.result);
  ASSERT_EQ(by_rolling.result->corners.size(), by_global.result->corners.size());
  EXPECT_EQ(by_rolling.result->corners.front().px_last, by_global.result->corners.front().px_last);
  for (const BootstrapView& view : by_rolling.result->views) {
    EXPECT_TRUE(view.is_straight);
    EXPECT_EQ(view.motion.velocity, turn.velocity);
  }
}

TEST_F(BootstrapOnSweep, TheSameSeedGivesTheSameResult) {
  Bootstrap a = make(3), b = make(3);
  const BootstrapResult ra = run(&a), rb = run(&b);
  ASSERT_EQ(ra.views.size(), rb.views.size());
  EXPECT_EQ(ra.views.back().T_cam_first.matrix(), rb.views.back().T_cam_first.matrix());
  ASSERT_EQ(ra.corners.size(), rb.corners.size());
  for (size_t i = 0; i < ra.corners.size(); ++i)
    EXPECT_EQ(ra.corners[i].idepth_first, rb.corners[i].idepth_first);
}

TEST_F(BootstrapOnSweep, ResetTakesANewFirstView) {
  Bootstrap bootstrap = make();
  (void)add(&bootstrap, 0);
  (void)add(&bootstrap, 1);
  bootstrap.reset();
  EXPECT_EQ(run(&bootstrap, 5).views.front().frame_index, 5);
}

// ---- not ready ----

TEST_F(BootstrapOnSweep, TheFirstFrameGivesNoResult) {
  Bootstrap bootstrap = make();
  const BootstrapStatus status = add(&bootstrap, 0);
  EXPECT_FALSE(status.result);
  EXPECT_EQ(to_string(status.reasons), "first view taken");
}

TEST_F(BootstrapOnSweep, ReportsNoMotionAtAStandstill) {
  Bootstrap bootstrap = make();
  for (int k = 0; k < 8; ++k) {
    const BootstrapStatus status =
        bootstrap.add(k, time_of(k), scene.pyramid(SE3(), 1.0, 0.0, 2.0, uint64_t(k)));
    ASSERT_FALSE(status.result);
    if (k == 0) continue;
    EXPECT_THAT(to_string(status.reasons), HasSubstr("median motion 0."));
  }
}

TEST_F(BootstrapOnSweep, GivesNoMapFromPureRotation) {
  Bootstrap bootstrap = make();
  int enough_motion = 0;
  for (int k = 0; k < 15; ++k) {
    const SE3 T_world_cam(
        Eigen::Quaterniond(Eigen::AngleAxisd(0.012 * k, Eigen::Vector3d(0.3, 1, 0).normalized())),
        Eigen::Vector3d::Zero());
    const BootstrapStatus status = bootstrap.add(k, time_of(k), scene.pyramid(T_world_cam));
    ASSERT_FALSE(status.result) << k;
    // Corners behind a camera, too little parallax or no common motion: which one is up to chance, but a
    // reason is reported.
    if (k > 0 && to_string(status.reasons).find("median motion") == std::string::npos) ++enough_motion;
    EXPECT_NE(to_string(status.reasons), "");
  }
  EXPECT_GT(enough_motion, 3);
}

TEST_F(BootstrapOnSweep, ReportsThatABlankImageHasNoCorners) {
  Bootstrap bootstrap = make();
  const auto blank =
      PyramidBuilder(scene.camera, EdgeParams()).build(test::make_image(320, 240, [](double, double) {
        return 77;
      }));
  for (int k = 0; k < 3; ++k) {
    const BootstrapStatus status = bootstrap.add(k, time_of(k), blank);
    EXPECT_FALSE(status.result);
    EXPECT_THAT(to_string(status.reasons), HasSubstr("only 0 corners in the image, 80 needed"));
  }
  EXPECT_EQ(run(&bootstrap, 3).views.front().frame_index, 3);
}

TEST_F(BootstrapOnSweep, ReportsThatCornersAreTooFew) {
  Bootstrap bootstrap = make();
  const auto discs =
      PyramidBuilder(scene.camera, EdgeParams()).build(test::disc_image(320, 240, {160, 120}, 30, 60, 200));
  const BootstrapStatus status = bootstrap.add(0, time_of(0), discs);
  EXPECT_FALSE(status.result);
  EXPECT_THAT(to_string(status.reasons), ::testing::ContainsRegex("only [0-9]+ corners in the image"));
}

TEST_F(BootstrapOnSweep, RestartsWhenTheCornersAreGone) {
  Bootstrap bootstrap = make();
  (void)add(&bootstrap, 0);
  const HollowScene other(99);
  const BootstrapStatus status = bootstrap.add(1, time_of(1), other.pyramid(SE3()));
  EXPECT_FALSE(status.result);
  EXPECT_THAT(to_string(status.reasons), HasSubstr("new first view"));
}

TEST_F(BootstrapOnSweep, TakesANewFirstViewAfterTooManyFrames) {
  params = BootstrapParams();
  params.max_frames = 5;
  Bootstrap bootstrap = make();
  for (int k = 0; k < 5; ++k)
    EXPECT_FALSE(bootstrap.add(k, time_of(k), scene.pyramid(sweep_pose(20))).result);
  const BootstrapStatus status = bootstrap.add(5, time_of(5), scene.pyramid(sweep_pose(20)));
  EXPECT_FALSE(status.result);
  EXPECT_EQ(to_string(status.reasons), "too little motion for too long; new first view");
  // Frames from 21 on move: the result must not go back beyond the new first view.
  BootstrapStatus moving;
  for (int k = 6; !moving.result && k < 30; ++k)
    moving = bootstrap.add(k, time_of(k), scene.pyramid(sweep_pose(20 + 4 * (k - 5))));
  ASSERT_TRUE(moving.result);
  EXPECT_GE(moving.result->views.front().frame_index, 5);
}

// Every other strip of the first image is displaced, as by moving shadows: half of its corners agree with no
// later view.
TEST_F(BootstrapOnSweep, GivesUpAFirstViewThatDisagreesWithAllOthers) {
  GrayImage torn = scene.render(sweep_pose(0));
  const GrayImage whole = torn;
  constexpr int kStrip = 40, kShift = 9;
  for (int y = 0; y + kShift < torn.height; ++y)
    for (int x = 0; x < torn.width; ++x)
      if (x / kStrip % 2)
        torn.pixels[size_t(y) * torn.width + x] = whole.pixels[size_t(y + kShift) * torn.width + x];
  Bootstrap bootstrap = make();
  std::string given_up;
  BootstrapStatus status =
      bootstrap.add(0, time_of(0), PyramidBuilder(scene.camera, EdgeParams()).build(torn));
  for (int k = 1; k < 60 && !status.result; ++k) {
    status = add(&bootstrap, k);
    if (to_string(status.reasons).find("; new first view") != std::string::npos)
      given_up += to_string(status.reasons);
  }
  EXPECT_THAT(given_up, HasSubstr("of the corners agree on one motion"));
  ASSERT_TRUE(status.result);
  EXPECT_GT(status.result->views.front().frame_index, 0);
}

// The nearest third of the image goes dark: the remaining corners have moved less than the median.
TEST_F(BootstrapOnSweep, LostCornersCountAsMovedFurther) {
  params.min_disparity = 0.4;  // never enough: the reason contains the median motion
  const auto median_motion = [&](bool count_lost_corners) {
    params.count_lost_corners = count_lost_corners;
    Bootstrap bootstrap = make();
    (void)add(&bootstrap, 0);
    GrayImage dark = scene.render(sweep_pose(4));
    for (int y = 0; y < dark.height; ++y)
      std::fill_n(dark.pixels.begin() + ptrdiff_t(y) * dark.width, dark.width / 3, uint8_t(0));
    const BootstrapStatus status =
        bootstrap.add(4, time_of(4), PyramidBuilder(scene.camera, EdgeParams()).build(dark));
    double px = 0;
    EXPECT_EQ(std::sscanf(to_string(status.reasons).c_str(), "median motion %lf px", &px), 1)
        << to_string(status.reasons);
    return px;
  };
  EXPECT_GT(median_motion(true), median_motion(false));
}

TEST_F(BootstrapOnSweep, KeepsMemoryBounded) {
  params.min_disparity = 0.4;  // never enough
  Bootstrap bootstrap = make();
  std::vector<std::weak_ptr<const FramePyramid>> pyramids;
  for (int k = 0; k < 40; ++k) {
    auto pyramid = scene.pyramid(SE3());
    pyramids.push_back(pyramid);
    EXPECT_FALSE(bootstrap.add(k, time_of(k), std::move(pyramid)).result);
  }
  int kept = 0;
  for (const auto& p : pyramids) kept += !p.expired();
  EXPECT_LE(kept, 16);
}

}  // namespace
}  // namespace edgevo
