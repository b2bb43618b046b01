// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/run_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/synthetic_run.h"
#include "support/text.h"

namespace edgevo {
namespace {

using test::cells_of;
using test::lines_of;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

class RunText : public ::testing::Test {
 protected:
  const test::SyntheticRun made_ = test::synthetic_run();
};

TEST_F(RunText, FramesCsvHasARowForEveryFrameAndTimesLast) {
  const auto rows = lines_of(frames_csv(made_.run));
  ASSERT_EQ(rows.size(), 46u);
  EXPECT_EQ(
      rows[0],
      "index,time,state,segment,keyframe,inlier_share,residual_px,edges,note,keyframe_rule,latency_ms,"
      "visible_points,matched_points,pose_sigma,step_sigmas,known_points,lacking_share,view_share,"
      "saturated_share,edge_blur,median_depth,moved_by_map,adjusted_move,adjusted_cost,adjusted_matches,"
      "adjusted_points,adjusted_here,adjusted_unit_sigma,corners,corners_agreeing,corner_scale,"
      "corner_scale_sigma,corner_change_10,"
      "corner_change_10_sigma,corner_change_50,corner_change_50_sigma,corner_motion,corner_motion_sigma,"
      "corner_motion_depths,corner_rotation_deg,corner_rotation_sigma,corner_direction_deg,"
      "corner_direction_sigma,focal_error,focal_error_sigma,unit_linked,unit_ratio,unit_sigma,p_right,"
      "keyframe_doubtful,stands,posed_later,ms_edges,ms_alignment,ms_ba");
  EXPECT_EQ(
      rows[2],
      "1,1670000000.1000000,BOOTSTRAPPING,0,0,0.8000,0.5000,1001,,,,399,398,0.000600,,400,0.2000,0.6000,"
      "0.0100,0.900,5.000000,,,,,,,,,,,,,,,,,,,,,,,,,,,,,0,0,0,4.100,2.000,");
  EXPECT_EQ(rows[21],
            "20,1670000002.0000000,LOST,-1,0,0.0000,0.0000,1020,lost: 3 of 400 points aligned; 120 "
            "needed,,,,,,,,,,0.0100,0.900,,,,,,,,,,,,,,,,,,,,,,,,,,,,,,0,0,0,6.000,2.000,");
  EXPECT_EQ(
      rows[46 - 3],
      "42,1670000004.2000000,TRACKING,1,1,0.8000,0.5000,1042,,view leaves,,358,316,0.000600,0.500,"
      "400,0.2000,0.6000,0.0100,0.900,5.000000,,1.2500,0.7000,2000,700,400,0.0000,,,,,,,,,,,,,,,,,,,,,,0,0,1,"
      "8.200,2.000,20.000");
  for (const std::string& row : rows) EXPECT_EQ(cells_of(row).size(), 55u) << row;
}

TEST_F(RunText, FramesCsvHoldsWhatCornersSay) {
  edgevo::Run run;
  run.frames.resize(1);
  CornerEvidence& corners = run.frames[0].evidence.corners.emplace();
  corners.tracks = 76;
  corners.agreeing_share = 0.9;
  corners.change_10 = -0.35667, corners.change_10_sigma = 0.05;
  corners.direction_deg = 1.5, corners.direction_sigma_deg = 180;
  EXPECT_THAT(lines_of(frames_csv(run))[1], HasSubstr(",76,0.900,,,-0.3567,0.0500,,,,,,,,1.50,180.00,"));
}

TEST_F(RunText, FramesCsvHoldsTheUnitOfLengthAfterADoubt) {
  edgevo::Run run;
  run.frames.resize(3);
  run.frames[1].evidence.unit = RelativeScale{1.0125, 0.028};
  run.frames[2].evidence.unit = RelativeScale{};
  const auto rows = lines_of(frames_csv(run));
  EXPECT_THAT(rows[1], Not(HasSubstr(",1.0125,")));
  EXPECT_THAT(rows[2], HasSubstr(",,,1,1.0125,0.0280,,0"));
  EXPECT_THAT(rows[3], HasSubstr(",,,0,,,,0"));
}

TEST_F(RunText, TumTrajectoriesHoldTheFramesThatHavePoses) {
  const auto final_lines = lines_of(trajectory_tum(made_.run, PoseKind::kFinal));
  const auto live_lines = lines_of(trajectory_tum(made_.run, PoseKind::kLive));
  EXPECT_EQ(final_lines.size(), 4u + 40);
  EXPECT_EQ(live_lines.size(), 4u + 36);
  EXPECT_THAT(final_lines[0], StartsWith("# edgevo: T_world_cam"));
  EXPECT_THAT(final_lines[2], StartsWith("# unit: arbitrary"));
  EXPECT_EQ(final_lines[4],
            "1670000000.0000000 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 "
            "1.000000000");
}

TEST_F(RunText, TumQuaternionsHaveAPositiveW) {
  edgevo::Run run;
  run.frames.resize(1);
  run.frames[0].T_world_cam = SE3(Eigen::Quaterniond(-0.8, 0.6, 0, 0), Eigen::Vector3d(1, -2, 3));
  EXPECT_EQ(
      lines_of(trajectory_tum(run, PoseKind::kFinal))[4],
      "0.0000000 1.000000000 -2.000000000 3.000000000 -0.600000000 0.000000000 0.000000000 0.800000000");
}

TEST_F(RunText, KittiTrajectoryRepeatsThePoseOfFramesWithoutOne) {
  const auto rows = lines_of(trajectory_kitti(made_.run));
  ASSERT_EQ(rows.size(), 45u);
  for (int i = 20; i < 25; ++i) EXPECT_EQ(rows[size_t(i)], rows[19]);
  EXPECT_NE(rows[25], rows[24]);
  edgevo::Run late;
  late.frames.resize(2);
  EXPECT_THAT(lines_of(trajectory_kitti(late))[0],
              StartsWith("1.000000000 0.000000000 0.000000000 0.000000000 0.000000000 1.0"));
}

}  // namespace
}  // namespace edgevo
