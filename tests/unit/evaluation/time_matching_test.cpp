// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/evaluation/time_matching.h"

#include <gmock/gmock.h>

#include "support/synthetic_trajectory.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

using test::input_error_of;
using test::TempFolder;
using ::testing::EndsWith;
using ::testing::HasSubstr;

Timestamp at(double s) { return Timestamp::from_seconds(s); }

Trajectory turning() {  // 10 Hz, 90 degrees about z and 1 m along x a step
  Trajectory t{"gt.txt", TrajectoryFormat::kTum, {}};
  for (int i = 0; i < 4; ++i)
    t.poses.push_back(
        {at(0.1 * i), SE3(Eigen::Quaterniond(Eigen::AngleAxisd(M_PI / 2 * i, Eigen::Vector3d::UnitZ())),
                          Eigen::Vector3d(i, 0, 0))});
  return t;
}

TEST(GroundTruth, InterpolatesPositionAndRotation) {
  const Trajectory t = turning();
  const SE3 T = GroundTruth(t).at(at(0.125)).value();
  EXPECT_TRUE(T.translation().isApprox(Eigen::Vector3d(1.25, 0, 0), 1e-12));
  const Eigen::Quaterniond expected(Eigen::AngleAxisd(1.25 * M_PI / 2, Eigen::Vector3d::UnitZ()));
  EXPECT_LT(T.rotation().angularDistance(expected), 1e-9);
}

TEST(GroundTruth, ReturnsItsOwnPosesUnchanged) {
  const Trajectory t = turning();
  for (const StampedPose& p : t.poses) EXPECT_EQ(GroundTruth(t).at(p.time)->matrix(), p.T_world_cam.matrix());
}

TEST(GroundTruth, IsUnknownOutsideItsSpan) {
  const Trajectory t = turning();
  const GroundTruth truth(t);
  EXPECT_FALSE(truth.at(at(-0.01)));
  EXPECT_FALSE(truth.at(at(0.31)));
  EXPECT_TRUE(truth.at(at(-0.00005)));  // rounding of a file
  EXPECT_TRUE(truth.at(at(0.30005)));
}

TEST(GroundTruth, IsUnknownInsideALongGap) {
  Trajectory t = turning();
  t.poses.push_back({at(1.35), SE3()});  // 1.05 s after the last, ten median steps are 1 s
  t.poses.push_back({at(1.45), SE3()});
  const GroundTruth truth(t);
  EXPECT_FALSE(truth.at(at(0.8)));
  EXPECT_TRUE(truth.at(at(1.4)));
  EXPECT_TRUE(truth.at(at(1.35)));
}

TEST(Associate, MatchesAnEstimateOfAnotherRate) {
  const Trajectory dense = test::straight_drive(101, 0.1);  // 10 Hz, 0.1 m a step
  Trajectory estimate{"est.txt", TrajectoryFormat::kTum, {}};
  for (int i = 0; i < 20; ++i) estimate.poses.push_back({at(0.33 * i), SE3()});
  const TimeMatches a = match_by_time(estimate, dense, test::frames_of(estimate));
  ASSERT_EQ(a.matches.size(), 20u);
  for (int i = 0; i < 20; ++i) {
    EXPECT_NEAR(a.matches[size_t(i)].T_gt.translation().z(), 0.33 * i, 1e-9);
    EXPECT_EQ(a.matches[size_t(i)].frame, i);
  }
}

TEST(Associate, KeepsFramesWithoutPoseAndPosesWithoutGroundTruth) {
  const Trajectory truth = test::straight_drive(10);
  Trajectory estimate = test::straight_drive(12);
  estimate.poses.erase(estimate.poses.begin() + 4);
  const TimeMatches a = match_by_time(estimate, truth, test::frames_of(test::straight_drive(12)));
  EXPECT_EQ(a.matches.size(), 9u);
  EXPECT_EQ(a.without_ground_truth, 2);
  ASSERT_EQ(a.frames.size(), 12u);
  EXPECT_FALSE(a.frames[4].has_pose);
  EXPECT_EQ(a.frames[4].match, -1);
  EXPECT_TRUE(a.frames[4].T_gt);
  EXPECT_TRUE(a.frames[11].has_pose);
  EXPECT_FALSE(a.frames[11].T_gt);
  EXPECT_EQ(a.frames[5].match, 4);
}

TEST(Associate, TooFewMatchesIsAnInputError) {
  Trajectory late = test::straight_drive(10);
  for (StampedPose& p : late.poses) p.time.ticks += 100 * Timestamp::kTicksPerSecond;
  const std::string error =
      input_error_of([&] { match_by_time(late, test::straight_drive(10), test::frames_of(late)); });
  EXPECT_THAT(error, HasSubstr("only 0 of its 10 poses"));
}

TEST(InputFrames, FramesCsvNextToTheTrajectoryComesFirst) {
  const TempFolder run, data;
  Trajectory estimate = test::straight_drive(5), truth = test::straight_drive(9);
  estimate.path = run / "trajectory_tum.txt";
  truth.path = data / "groundtruth_tum.txt";
  data.write("times.txt", "0\n1\n2\n3\n4\n5\n6\n");
  EXPECT_THAT(find_input_frames(estimate, truth, {}).source, EndsWith("times.txt"));
  EXPECT_EQ(find_input_frames(estimate, truth, {}).times.size(), 7u);
  run.write("frames.csv", "index,time,state\n3,0.3,LOST\n4,0.4,LOST\n\n");
  const InputFrames frames = find_input_frames(estimate, truth, {});
  EXPECT_THAT(frames.source, EndsWith("frames.csv"));
  ASSERT_EQ(frames.times.size(), 2u);
  EXPECT_EQ(frames.times[1], at(0.4));
  EXPECT_EQ(find_input_frames(estimate, truth, 77).times.size(), 77u);
}

TEST(InputFrames, BrokenListsAreErrorsWithFileAndLine) {
  const TempFolder run;
  Trajectory estimate = test::straight_drive(5);
  estimate.path = run / "t.txt";
  const auto error = [&](const std::string& csv) {
    run.write("frames.csv", csv);
    return input_error_of([&] { find_input_frames(estimate, test::straight_drive(5), {}); });
  };
  EXPECT_THAT(error("index,when\n1,2\n"), HasSubstr("frames.csv:1: has no column named time"));
  EXPECT_THAT(error("index,time\n1,x\n"), HasSubstr("frames.csv:2: the time is not a number"));
  EXPECT_THAT(error("index,time\n1\n"), HasSubstr("frames.csv:2: the time is not a number"));
  EXPECT_THAT(error("index,time\n1,2\n2,2\n"), HasSubstr("frames.csv:3: time 2.0000000 does not come after"));
  EXPECT_THAT(error("index,time\n"), HasSubstr("lists no frame"));
}

TEST(InputFrames, GroundTruthLinesAreUsedIfTheRatesAreSimilar) {
  Trajectory estimate = test::straight_drive(10);
  estimate.poses.erase(estimate.poses.begin(), estimate.poses.begin() + 3);
  EXPECT_EQ(find_input_frames(estimate, test::straight_drive(12), {}).times.size(), 12u);
}

TEST(InputFrames, OtherwiseTheSpanOfTheTrajectoryIsUsed) {
  Trajectory estimate = test::straight_drive(30), thinned = estimate;
  thinned.poses.clear();
  for (int i = 0; i < 30; i += 3)
    if (i != 12) thinned.poses.push_back(estimate.poses[size_t(i)]);
  const InputFrames frames = find_input_frames(thinned, estimate, {});
  EXPECT_EQ(frames.times.size(), 10u);
  EXPECT_THAT(frames.source, HasSubstr("span of the trajectory"));
}

TEST(InputFrames, ATotalBelowTheNumberOfPosesIsRefused) {
  const Trajectory t = test::straight_drive(10);
  EXPECT_THAT(input_error_of([&] { find_input_frames(t, t, 9); }), HasSubstr("holds 10 poses"));
}

}  // namespace
}  // namespace edgevo
