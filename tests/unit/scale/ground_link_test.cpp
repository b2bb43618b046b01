// SPDX-License-Identifier: BSD-3-Clause
// A drive that loses its unit of length in two seconds without sight.
#include "ground_link.h"

#include <gtest/gtest.h>

#include "drive_over_ground.h"
#include "edgevo/core/record_units.h"
#include "edgevo/run_quality/doubtful_intervals.h"
#include "edgevo/scale/run_scale.h"

namespace edgevo {
namespace {

constexpr int kLost = 140, kSeen = 160, kCompared = 175;  // frames of 300
constexpr double kLengths = 0.35;                         // after over before

// Lengths after the gap become kLengths times as long, and nothing links them to those before.
test::MadeRun drive_with_a_gap(double ground_share = 0.6) {
  test::GroundDrive drive;
  drive.ground_share = ground_share;
  test::MadeRun made = test::drive_over_ground(drive);
  const Eigen::Vector3d pivot = made.run.frames[kSeen].T_world_cam->translation();
  const auto shorten = [&](SE3* T) {
    *T = SE3(T->rotation(), pivot + kLengths * (T->translation() - pivot));
  };
  for (FrameRecord& f : made.run.frames) {
    if (f.index >= kSeen) shorten(&*f.T_world_cam), shorten(&*f.T_world_cam_live);
    if (f.index < kLost || f.index >= kSeen) continue;
    f.T_world_cam.reset(), f.T_world_cam_live.reset();
    f.segment = -1, f.state = TrackingState::kLost;
  }
  auto& keyframes = made.run.keyframes;
  keyframes.erase(
      std::remove_if(keyframes.begin(), keyframes.end(),
                     [](const KeyframeRecord& k) { return k.frame_index >= kLost && k.frame_index < kSeen; }),
      keyframes.end());
  for (KeyframeRecord& k : keyframes)
    if (k.frame_index >= kSeen) shorten(&k.T_world_cam), multiply_depths(kLengths, &k);
  made.run.frames[kCompared].evidence.unit = RelativeScale();
  return made;
}

double length_between(const Run& run, size_t from, size_t to) {
  return (run.frames[to].T_world_cam->translation() - run.frames[from].T_world_cam->translation()).norm();
}

TEST(GroundLink, TheCamerasHeightLinksWhatNothingElseDoes) {
  test::MadeRun made = drive_with_a_gap();
  const SE3 live = *made.run.frames[250].T_world_cam_live;
  link_units_by_ground(ScaleParams(), &made.run);
  const auto true_length = [&](size_t a, size_t b) {
    return (made.truth[b].translation() - made.truth[a].translation()).norm() / 2;  // 2 metres a unit
  };
  EXPECT_NEAR(length_between(made.run, 200, 280) / true_length(200, 280), 1, 0.02);
  EXPECT_NEAR(length_between(made.run, 20, 100) / true_length(20, 100), 1, 1e-9) << "the first unit stays";
  EXPECT_EQ(made.run.frames[250].T_world_cam_live->translation(), live.translation());
  double deepest = 0;
  for (const EdgePoint& p : made.run.keyframes.back().points)
    deepest = std::max(deepest, 1.0 / double(p.idepth));
  EXPECT_NEAR(deepest, 7.25, 0.7) << "points lie up to 15 m ahead";

  const auto& unit = made.run.frames[kCompared].evidence.unit;
  ASSERT_TRUE(unit && unit->is_linked());
  EXPECT_TRUE(unit->by_ground);
  EXPECT_LT(std::abs(std::log(unit->ratio * kLengths)), 3 * unit->sigma);
  EXPECT_LT(unit->sigma, 0.04);
  const std::vector<DoubtfulInterval> intervals = doubtful_intervals(made.run);
  ASSERT_EQ(intervals.size(), 1u);
  EXPECT_NE(
      to_string(intervals[0])
          .find("the height over the ground links the unit of length after it to that before (times 2.8"),
      std::string::npos);
}

TEST(GroundLink, WithoutGroundEachPartKeepsItsUnit) {
  test::MadeRun made = drive_with_a_gap(0);
  const SE3 before = *made.run.frames[250].T_world_cam;
  link_units_by_ground(ScaleParams(), &made.run);
  EXPECT_LT((made.run.frames[250].T_world_cam->translation() - before.translation()).norm(), 1e-9);
  EXPECT_TRUE(doubtful_intervals(made.run)[0].is_scale_unresolved());
}

TEST(GroundLink, AMoreCertainLinkByFeaturesIsNotTouched) {
  test::MadeRun made = drive_with_a_gap();
  made.run.frames[kCompared].evidence.unit = RelativeScale{1.0, 0.001};
  const SE3 before = *made.run.frames[250].T_world_cam;
  link_units_by_ground(ScaleParams(), &made.run);
  EXPECT_EQ(made.run.frames[250].T_world_cam->translation(), before.translation());
  EXPECT_FALSE(made.run.frames[kCompared].evidence.unit->by_ground);
}

// Two views of a drive link units that differ by a tenth at a stated 3 %.
TEST(GroundLink, ALessCertainOneIsReplaced) {
  test::MadeRun made = drive_with_a_gap();
  made.run.frames[kCompared].evidence.unit = RelativeScale{1.0, 0.1};
  link_units_by_ground(ScaleParams(), &made.run);
  EXPECT_NEAR(length_between(made.run, 200, 280) / length_between(made.run, 20, 100), 1, 0.05);
  EXPECT_TRUE(made.run.frames[kCompared].evidence.unit->by_ground);
}

// Within the 40 m over which a scale is estimated both units would count.
TEST(GroundLink, AGivenHeightIsMeasuredInEachUnitByItself) {
  test::MadeRun made = drive_with_a_gap();
  const ScaleSource height{ScaleSource::Kind::kCameraHeight, 1.65, "camera_height=1.65"};
  const RunScale scale = estimate_run_scale(made.run, height, {}, ScaleParams());
  ASSERT_EQ(scale.problem, "");
  EXPECT_NEAR(scale.of_frame[kLost - 1].factor, 2, 0.05);
  EXPECT_NEAR(scale.of_frame[kSeen].factor, 2 / kLengths, 0.05 / kLengths);
}

}  // namespace
}  // namespace edgevo
