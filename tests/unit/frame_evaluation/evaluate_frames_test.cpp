// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/frame_evaluation/evaluate_frames.h"

#include <gmock/gmock.h>

#include "edgevo/core/doubtful_frame.h"
#include "made_run.h"

namespace edgevo {
namespace {

using test::evaluated_frames;
using test::made_run;
using test::MadeRun;
using test::winding_drive;
using test::wrong_frames;

FrameEvaluation evaluated(const MadeRun& made) { return evaluate_frames(made.reported, made.truth); }

TEST(EvaluateFrames, ARunThatIsRightHasNoWrongFrameWhateverItsUnit) {
  const FrameEvaluation j = evaluated(made_run(winding_drive(200)));
  EXPECT_EQ(evaluated_frames(j), 195) << "all but the last five, after which too little follows";
  EXPECT_EQ(wrong_frames(j), 0);
  EXPECT_EQ(j.longest_unnoticed, 0);
  EXPECT_EQ(j.longest_off_scale, 0);
  EXPECT_NEAR(j.frames[100].units_per_m, MadeRun::kUnitsPerMetre, 1e-9);
  EXPECT_NEAR(j.frames[100].scale_ratio, 1, 1e-9);
}

// One step of four metres too much: of ten metres in ten frames that is 40 %, in all motions that hold it.
TEST(EvaluateFrames, OneWrongStepMakesTheTenMotionsThatHoldItWrong) {
  const FrameEvaluation j = evaluated(made_run(winding_drive(200), [](int i) { return i == 100 ? 5 : 1; }));
  for (int i = 0; i < 195; ++i) EXPECT_EQ(j.frames[size_t(i)].wrong, i > 90 && i <= 100) << i;
  EXPECT_EQ(j.longest_unnoticed, 10);
  EXPECT_NEAR(j.frames[95].miss_m, 4, 0.1);
}

TEST(EvaluateFrames, BothBoundsOfTheTranslationMustBeExceeded) {
  // Half a metre of ten: above 2 % of the depth, below 25 % of the length.
  EXPECT_EQ(wrong_frames(evaluated(made_run(winding_drive(200), [](int i) { return i == 100 ? 1.5 : 1; }))),
            0);
  // Steps of a centimetre: ten times too long is above 25 % of the length, below 2 % of the depth.
  EXPECT_EQ(
      wrong_frames(evaluated(made_run(winding_drive(200, 0.01), [](int i) { return i == 100 ? 11 : 1; }))),
      0);
}

TEST(EvaluateFrames, ATurnOfMoreThanThreeDegreesIsWrong) {
  const auto turn_by = [](double deg) {
    return evaluated(
        made_run(winding_drive(200, 0.01), {}, [=](int i) { return i == 100 ? deg * M_PI / 180 : 0; }));
  };
  EXPECT_EQ(wrong_frames(turn_by(2.8)), 0);
  EXPECT_EQ(wrong_frames(turn_by(3.2)), 10);
}

// Within 12 frames the scale falls to 0.4 and stays there: wrong from the first motion that is 25 % short
// until most of the fifty frames before are in the new scale.
TEST(EvaluateFrames, AScaleThatFallsIsWrongUntilItIsTheUsualOne) {
  const auto falling = [](int i) { return i < 100 ? 1 : i < 112 ? 1 - 0.05 * (i - 99) : 0.4; };
  const FrameEvaluation j = evaluated(made_run(winding_drive(300), falling));
  EXPECT_FALSE(j.frames[90].wrong);
  for (int i = 100; i < 130; ++i) EXPECT_TRUE(j.frames[size_t(i)].wrong) << i;
  EXPECT_FALSE(j.frames[160].wrong);
  EXPECT_GT(j.longest_unnoticed, 30);
  EXPECT_NEAR(j.frames[112].scale_ratio, 0.4, 0.02);
  EXPECT_GT(j.longest_off_scale, 180) << "without a word the new scale stays off";
}

TEST(EvaluateFrames, AScaleThatCreepsIsOffThoughNoFrameIsWrong) {
  const FrameEvaluation j =
      evaluated(made_run(winding_drive(800), [](int i) { return std::pow(2, -i / 800.0); }));
  EXPECT_EQ(wrong_frames(j), 0);
  EXPECT_NEAR(j.longest_off_scale, 800 * (1 - std::log2(1.5)) - 30, 30);
}

TEST(EvaluateFrames, AWordBeginsTheScaleAnew) {
  MadeRun made = made_run(winding_drive(300), [](int i) { return i < 100 ? 1 : 0.4; });
  made.reported[104].state = TrackingState::kDegraded;
  const FrameEvaluation j = evaluated(made);
  EXPECT_LT(j.longest_off_scale, 15);
}

TEST(EvaluateFrames, NoticedIsWhatIsSaidWithinTenFrames) {
  const auto with = [](int at, const std::function<void(ReportedFrame*)>& say) {
    MadeRun made = made_run(winding_drive(200), [](int i) { return i == 100 ? 5 : 1; });
    say(&made.reported[size_t(at)]);
    return evaluated(made);
  };
  const auto degrade = [](ReportedFrame* c) { c->state = TrackingState::kDegraded; };
  EXPECT_EQ(with(101, degrade).longest_unnoticed, 0) << "motions 91 to 100 all hold frame 101";
  EXPECT_EQ(with(105, degrade).longest_unnoticed, 4) << "from 91 to 94 it is too late";
  EXPECT_EQ(with(111, degrade).longest_unnoticed, 10);
  EXPECT_EQ(with(101, [](ReportedFrame* c) { c->p_right = 0.1; }).longest_unnoticed, 0);
  EXPECT_EQ(with(101, [](ReportedFrame* c) { c->p_right = 0.5 * (1 + kDoubtfulBelow); }).longest_unnoticed,
            10);
}

TEST(EvaluateFrames, AlarmsRightAfterAWrongFrameAreNotFalse) {
  MadeRun made = made_run(winding_drive(200), [](int i) { return i == 100 ? 5 : 1; });
  const FrameEvaluation j = evaluated(made);
  for (int i = 0; i < 195; ++i) EXPECT_EQ(j.frames[size_t(i)].aftermath, i > 100 && i <= 110) << i;
}

TEST(EvaluateFrames, ACameraThatStandsKeepsItsScale) {
  // Ten metres, a stand of 150 frames, and on: in the same scale, then in a third of it.
  Trajectory truth = winding_drive(60);
  const SE3 here = truth.poses.back().T_world_cam;
  for (int i = 60; i < 210; ++i)
    truth.poses.push_back({Timestamp{i * Timestamp::kTicksPerSecond / 10}, here});
  const Trajectory on = winding_drive(60);
  for (int i = 0; i < 60; ++i)
    truth.poses.push_back(
        {Timestamp{(210 + i) * Timestamp::kTicksPerSecond / 10}, here * on.poses[size_t(i)].T_world_cam});
  EXPECT_EQ(wrong_frames(evaluated(made_run(truth))), 0);
  EXPECT_GT(wrong_frames(evaluated(made_run(truth, [](int i) { return i < 200 ? 1 : 0.33; }))), 20);
}

TEST(EvaluateFrames, WhatMovesBeforeAStandingCameraIsAnErrorWithoutAnyScale) {
  Trajectory truth{"standing", TrajectoryFormat::kTum, {}};
  for (int i = 0; i < 100; ++i)
    truth.poses.push_back({Timestamp{i * Timestamp::kTicksPerSecond / 10}, SE3()});
  MadeRun made = made_run(truth);
  EXPECT_EQ(evaluated_frames(evaluated(made)), 95);
  EXPECT_EQ(wrong_frames(evaluated(made)), 0);
  for (int i = 50; i < 100; ++i)  // 2 % of the depth in three frames
    made.reported[size_t(i)].T_world_cam =
        *made.reported[0].T_world_cam *
        SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, 0.03 * (i - 49)));
  EXPECT_GT(wrong_frames(evaluated(made)), 40);
}

TEST(EvaluateFrames, ARotationInPlaceIsEvaluatedByItsAngle) {
  Trajectory truth{"rotation", TrajectoryFormat::kTum, {}};
  for (int i = 0; i < 100; ++i)
    truth.poses.push_back({Timestamp{i * Timestamp::kTicksPerSecond / 10},
                           SE3(Eigen::Quaterniond(Eigen::AngleAxisd(0.02 * i, Eigen::Vector3d::UnitY())),
                               Eigen::Vector3d::Zero())});
  EXPECT_EQ(wrong_frames(evaluated(made_run(truth))), 0);
  EXPECT_EQ(wrong_frames(evaluated(made_run(truth, {}, [](int i) { return i == 50 ? -0.06 : 0; }))), 10);
}

TEST(EvaluateFrames, AMotionIsEvaluatedAsFarAsItGoesAndNotAcrossABorder) {
  MadeRun made = made_run(winding_drive(200), [](int i) { return i == 97 ? 8 : i == 110 ? 20 : 1; });
  for (int i = 100; i < 200; ++i) {
    if (i <= 110) made.reported[size_t(i)].T_world_cam.reset(), made.reported[size_t(i)].segment = -1;
    if (i > 110) made.reported[size_t(i)].segment = 1;
  }
  const FrameEvaluation j = evaluated(made);
  EXPECT_TRUE(j.frames[89].wrong && !j.frames[89].noticed) << "the loss comes eleven frames later";
  for (int i = 90; i <= 94; ++i) EXPECT_TRUE(j.frames[size_t(i)].wrong && j.frames[size_t(i)].noticed) << i;
  EXPECT_EQ(j.frames[94].end, 99);
  for (int i = 95; i <= 110; ++i) EXPECT_FALSE(j.frames[size_t(i)].is_evaluated) << i;
  EXPECT_TRUE(j.frames[111].is_evaluated) << "its segment has a scale of its own";
  EXPECT_FALSE(j.frames[111].wrong);
}

TEST(EvaluateFrames, ASegmentBeginsInItsOwnScale) {
  MadeRun made = made_run(winding_drive(200), [](int i) { return i < 100 ? 1 : 7; });
  for (int i = 100; i < 200; ++i)
    made.reported[size_t(i)].segment = 3, made.reported[size_t(i)].median_depth *= 7;
  EXPECT_EQ(wrong_frames(evaluated(made)), 0);
}

TEST(EvaluateFrames, WhatIsUnknownIsNotEvaluated) {
  MadeRun made = made_run(winding_drive(200));
  for (int i = 0; i < 50; ++i) made.reported[size_t(i)].state = TrackingState::kBootstrapping;
  made.truth.poses.resize(150);
  const FrameEvaluation j = evaluated(made);
  EXPECT_FALSE(j.frames[49].is_evaluated);
  EXPECT_TRUE(j.frames[50].is_evaluated);
  EXPECT_TRUE(j.frames[144].is_evaluated);
  EXPECT_FALSE(j.frames[145].is_evaluated);
  for (ReportedFrame& c : made.reported) c.median_depth = std::nan("");
  EXPECT_EQ(evaluated_frames(evaluated(made)), 0);
  made.reported[150].median_depth = 4;
  EXPECT_EQ(evaluated_frames(evaluated(made)), 95) << "the depth of the nearest frame of the segment serves";
}

// A GPS unit 1.5 m from the camera and turned by 6 degrees, in turns of 30 degrees in ten frames.
TEST(EvaluateFrames, TheTruthMayBeThatOfAnotherBody) {
  Trajectory truth = winding_drive(400, 0.8);
  for (int i = 0; i < 400; ++i) {
    SE3& T = truth.poses[size_t(i)].T_world_cam;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.6 * std::sin(0.06 * i), Eigen::Vector3d::UnitY()));
    T = SE3(turn * T.rotation(), T.translation());
  }
  const SE3 T_body_cam(
      Eigen::Quaterniond(Eigen::AngleAxisd(0.105, Eigen::Vector3d(0.2, 0.9, 0.3).normalized())),
      Eigen::Vector3d(0.3, -1, 1.1));
  MadeRun made = made_run(truth);
  EXPECT_LT(evaluated(made).T_body_cam.angle(), 1e-6) << "the truth of the camera is not moved";
  for (StampedPose& p : made.truth.poses) p.T_world_cam = p.T_world_cam * T_body_cam.inverse();
  const FrameEvaluation j = evaluated(made);
  EXPECT_LT((j.T_body_cam.inverse() * T_body_cam).angle(), 0.01);
  // The turns are about the vertical: they say nothing about the arm's height.
  const Eigen::Vector3d error = j.T_body_cam.translation() - T_body_cam.translation();
  EXPECT_LT(std::hypot(error.x(), error.z()), 0.3);
  EXPECT_EQ(wrong_frames(j), 0);
}

// A camera whose translations are all wrong alike: some turn of it makes them right, and its rotations wrong.
TEST(EvaluateFrames, NoMountExplainsWrongTranslationsAgainstTheRotations) {
  MadeRun made = made_run(winding_drive(400, 0.8));
  const Eigen::Quaterniond wrong(Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitX()));
  SE3 pose;
  for (size_t i = 0; i < made.reported.size(); ++i) {
    if (i > 0) {
      const SE3 step = made.truth.poses[i - 1].T_world_cam.inverse() * made.truth.poses[i].T_world_cam;
      pose = pose * SE3(step.rotation(), MadeRun::kUnitsPerMetre * (wrong * step.translation()));
    }
    made.reported[i].T_world_cam = pose;
  }
  EXPECT_LT(evaluated(made).T_body_cam.angle(), 1e-6);
}

TEST(TruthNoise, IsThatOfTheSamples) {
  EXPECT_NEAR(truth_noise(test::with_noise(winding_drive(500, 0.05), 0.01, 4)).position_m, 0.01, 0.001);
  EXPECT_LT(truth_noise(winding_drive(500, 0.05)).position_m, 1e-4);
  EXPECT_EQ(truth_noise(winding_drive(5)).position_m, 0);
}

TEST(EvaluateFrames, FramesThatTheNoiseOfTheTruthMayDecideAreNotEvaluated) {
  // The error of the wrong step is 0.5 m, the bound 0.2 m; a noise of 0.1 m leaves both sides possible.
  const auto factor = [](int i) { return i == 100 ? 11 : 1; };
  const MadeRun made = made_run(winding_drive(200, 0.05), factor);
  EXPECT_EQ(wrong_frames(evaluated(made)), 10);
  MadeRun noisy = made;
  noisy.truth = test::with_noise(made.truth, 0.1, 5);
  const FrameEvaluation j = evaluated(noisy);
  EXPECT_LT(evaluated_frames(j), 20);
  EXPECT_TRUE(j.frames[50].below_noise);
}

// A run with errors of its covariance, relative to every tenth frame.
MadeRun run_with_covariance() {
  MadeRun made = made_run(winding_drive(2000));
  Random random(3);
  const double sigma = 0.01;  // of all six; in the unit of the run
  for (int i = 0; i < 2000; ++i) {
    const int ref = i / 10 * 10;
    if (i == ref) continue;
    ReportedFrame& c = made.reported[size_t(i)];
    Vector6d xi;
    for (int k = 0; k < 6; ++k) xi[k] = sigma * random.normal();
    const SE3 T_cam_ref = SE3::exp(xi) * (c.T_world_cam->inverse() * *made.reported[size_t(ref)].T_world_cam);
    c.T_world_cam = *made.reported[size_t(ref)].T_world_cam * T_cam_ref.inverse();
    c.covariance = sigma * sigma * Matrix6d::Identity(), c.reference = ref;
  }
  return made;
}

double mean_nees(const FrameEvaluation& j) {
  double sum = 0;
  for (const double nees : j.nees) sum += nees;
  return sum / double(j.nees.size());
}

TEST(EvaluateFrames, TheCovarianceOfARightOneIsSix) {
  const FrameEvaluation j = evaluated(run_with_covariance());
  ASSERT_EQ(j.nees.size(), 1800u);
  EXPECT_NEAR(mean_nees(j), 6, 0.5);
}

// Errors of the truth that rise and fall within 30 frames do not show in its third differences.
TEST(EvaluateFrames, AStatedNoiseOfTheTruthIsNoErrorOfTheRun) {
  constexpr double kWaveM = 0.15;
  MadeRun made = run_with_covariance();
  for (size_t i = 0; i < made.truth.poses.size(); ++i) {
    SE3& T = made.truth.poses[i].T_world_cam;
    const Eigen::Vector3d off(kWaveM * std::sin(0.2 * double(i)), kWaveM * std::cos(0.2 * double(i)), 0);
    T = SE3(T.rotation(), T.translation() + off);
  }
  const FrameEvaluation unstated = evaluated(made);
  EXPECT_LT(unstated.noise.position_m, 0.1 * kWaveM);
  EXPECT_GT(mean_nees(unstated), 20);
  FrameEvaluationOptions options;
  options.stated_noise.position_m = kWaveM / std::sqrt(2.0);
  const FrameEvaluation stated = evaluate_frames(made.reported, made.truth, options);
  EXPECT_EQ(stated.noise.position_m, options.stated_noise.position_m);
  EXPECT_LT(mean_nees(stated), 8);
}

// It hides whether the camera stands: no motion of the run is wrong then.
TEST(EvaluateFrames, AStatedNoiseAboveTheWholePathLeavesNothingToEvaluate) {
  const MadeRun made = made_run(winding_drive(200));
  FrameEvaluationOptions options;
  options.stated_noise.position_m = 1000;
  const FrameEvaluation j = evaluate_frames(made.reported, made.truth, options);
  EXPECT_EQ(evaluated_frames(j), 0);
  EXPECT_EQ(wrong_frames(j), 0);
}

}  // namespace
}  // namespace edgevo
