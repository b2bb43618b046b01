// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/evaluation/evaluate.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "support/synthetic_trajectory.h"

namespace edgevo {
namespace {

using test::input_error_of;
using test::some_similarity;
using ::testing::HasSubstr;

TrajectoryEvaluation noisy_evaluation() {
  const Trajectory truth = test::winding_drive(300);
  Trajectory est = test::with_noise(test::seen_through(some_similarity(), truth), 0.05, 9);
  est.poses.erase(est.poses.begin() + 100, est.poses.begin() + 130);
  est.poses.erase(est.poses.begin(), est.poses.begin() + 5);
  return evaluate(est, truth, {});
}

TEST(Evaluate, CoverageAddsUp) {
  const Coverage c = noisy_evaluation().coverage;
  EXPECT_EQ(c.input_frames, 300);
  EXPECT_EQ(c.with_pose, 265);
  EXPECT_EQ(c.before_first_pose, 5);
  EXPECT_EQ(c.lost, 30);
  EXPECT_NEAR(c.completion_percent, 100.0 * 265 / 300, 1e-12);
  EXPECT_NEAR(c.failure_percent, 10.0, 1e-12);
}

TEST(Evaluate, AteEqualsTheAddedNoise) {
  const TrajectoryEvaluation e = noisy_evaluation();
  const double sigma_m = 0.05 * some_similarity().scale;
  EXPECT_NEAR(e.ate_sim3.rmse, std::sqrt(3.0) * sigma_m, 0.02);
  EXPECT_NEAR(e.ate_sim3.scale, some_similarity().scale, 0.01);
  EXPECT_GT(e.ate_se3.rmse, 10.0);
  EXPECT_EQ(e.matched, 265);
}

TEST(Evaluate, FramesTotalOverridesTheCount) {
  const Trajectory truth = test::winding_drive(100);
  EvaluationOptions options;
  options.frames_total = 200;
  EXPECT_NEAR(evaluate(truth, truth, options).coverage.completion_percent, 50.0, 1e-12);
}

TEST(Evaluate, KittiAgainstKitti) {
  Trajectory truth = test::winding_drive(250);
  truth.format = TrajectoryFormat::kKitti;
  Trajectory est = test::seen_through(some_similarity(), truth);
  const TrajectoryEvaluation e = evaluate(est, truth, {});
  EXPECT_LT(e.ate_sim3.rmse, 1e-9);
  EXPECT_EQ(e.coverage.input_frames, 250);
  EXPECT_LT(e.kitti->t_rel_percent, 1e-9);
  est.poses.push_back({Timestamp{1'000'000'000'000}, SE3()});
  EXPECT_THAT(input_error_of([&] { evaluate(est, truth, {}); }), HasSubstr("has more lines than"));
}

TEST(Evaluate, KittiAgainstTumNeedsAsManyLines) {
  const Trajectory truth = test::winding_drive(50);
  Trajectory est = test::seen_through(some_similarity(), truth);
  est.format = TrajectoryFormat::kKitti;
  for (size_t i = 0; i < est.poses.size(); ++i) est.poses[i].time = Timestamp::from_seconds(double(i));
  EXPECT_LT(evaluate(est, truth, {}).ate_sim3.rmse, 1e-9);
  est.poses.pop_back();
  EXPECT_THAT(input_error_of([&] { evaluate(est, truth, {}); }), HasSubstr("without times"));
}

TEST(Evaluate, TrajectoriesThatDoNotMoveAreRefused) {
  const Trajectory truth = test::winding_drive(20);
  Trajectory still = truth;
  still.path = "still.txt";
  for (StampedPose& p : still.poses)
    p.T_world_cam = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(1, 2, 3));
  const std::string expected = "still.txt: all its positions are equal";
  EXPECT_THAT(input_error_of([&] { evaluate(still, truth, {}); }), HasSubstr(expected));
  EXPECT_THAT(input_error_of([&] { evaluate(truth, still, {}); }), HasSubstr(expected));
}

TEST(Evaluate, TwoPosesAreTooFew) {
  Trajectory two = test::winding_drive(20);
  two.poses.resize(2);
  EXPECT_THAT(input_error_of([&] { evaluate(two, test::winding_drive(20), {}); }),
              HasSubstr("has only 2 pose(s); an evaluation needs 3"));
}

TEST(EvaluationReport, JsonHoldsTheNumbersOfTheValue) {
  const TrajectoryEvaluation e = noisy_evaluation();
  const nlohmann::json j = nlohmann::json::parse(to_json(e));
  EXPECT_EQ(j["ate_sim3"]["rmse_m"], e.ate_sim3.rmse);
  EXPECT_EQ(j["ate_se3"]["rmse_m"], e.ate_se3.rmse);
  EXPECT_EQ(j["ate200"]["rmse_m"], e.ate_blocks.rmse);
  EXPECT_EQ(j["drift"]["mean_cm_per_m"], e.drift->mean_cm_per_m);
  EXPECT_EQ(j["kitti"]["t_rel_percent"], e.kitti->t_rel_percent);
  EXPECT_EQ(j["local_scale"]["last"], e.scale_curve.back().relative_scale);
  EXPECT_EQ(j["coverage"]["completion_percent"], e.coverage.completion_percent);
}

TEST(EvaluationReport, FiguresThatDoNotExistAreNullAndDashes) {
  const Trajectory short_run = test::winding_drive(50);
  const TrajectoryEvaluation e = evaluate(short_run, short_run, {});
  EXPECT_TRUE(nlohmann::json::parse(to_json(e))["kitti"].is_null());
  EXPECT_THAT(to_table(e), ::testing::ContainsRegex("t_rel +-  %"));
}

TEST(EvaluationReport, TableStatesAlignmentUnitAndCount) {
  const std::string table = to_table(noisy_evaluation());
  for (const char* text : {"Sim(3), Umeyama", "SE(3), Umeyama", "265 poses", "cm/m", "every 200 input frames",
                           "30 without a pose after the first", "lines of the ground truth"})
    EXPECT_THAT(table, HasSubstr(text));
}

TEST(EvaluationReport, JsonEndsWithTheMembersOfOthers) {
  const nlohmann::ordered_json j =
      nlohmann::ordered_json::parse(to_json(noisy_evaluation(), {{"more", "{\"a\": 0.1}"}}));
  EXPECT_EQ(j["more"]["a"], 0.1);
  EXPECT_EQ(j.items().begin().key(), "trajectory");
  EXPECT_EQ(std::prev(j.end()).key(), "more");
}

TEST(EvaluationReport, PathsThatAreNotUtf8DoNotBreakJson) {
  Trajectory t = test::winding_drive(20);
  t.path = "caf\xe9.txt";
  EXPECT_NO_THROW(nlohmann::json::parse(to_json(evaluate(t, t, {}))));
}

}  // namespace
}  // namespace edgevo
