// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/benchmark/bench_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "edgevo/core/se3.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;

Trial trial(double ate_m, double cpu_ms = 20, double completion = 100) {
  Trial t;
  t.frames = 100;
  t.completion_percent = completion;
  t.segments = 1;
  t.cpu_ms = cpu_ms;
  t.evaluated = true;
  t.path_m = 50;
  t.ate_m = ate_m;
  t.ate200_m = ate_m / 2;
  t.drift_cm_per_m = 10 * ate_m;
  t.evaluated_frames = 90, t.wrong_frames = 10, t.noticed_frames = 8, t.right_frames = 80, t.false_alarms = 4;
  t.scale_error_percent = 7.5, t.doubtful_frames = 12, t.has_failed = ate_m > 0.25;
  t.longest_unnoticed = 2, t.longest_off_scale = 3, t.roc_area = 0.9;
  return t;
}

Trial lost_trial() {
  Trial t;
  t.frames = 100;
  t.note = "no frame has a pose";
  return t;
}

TEST(BenchTable, MedianAndMaximumOverSeeds) {
  const BenchRow row{"street", "normal", {trial(0.3, 30, 90), trial(0.1, 10), trial(0.2, 20)}, 0, ""};
  const std::string csv = bench_csv({{"edgevo", "1.0 abc"}, {"machine", "a processor"}}, {row});
  EXPECT_EQ(
      csv,
      "# edgevo: 1.0 abc\n# machine: a processor\n"
      "sequence,variant,trials,missing,path_m,ate_m_median,ate_m_worst,ate_percent_median,ate_percent_worst,"
      "ate200_m_median,"
      "ate200_m_worst,drift_cm_per_m_median,drift_cm_per_m_worst,scale_error_percent_median,"
      "scale_error_percent_worst,completion_percent_median,completion_"
      "percent_worst,segments_median,"
      "segments_worst,doubtful_frames_median,doubtful_frames_worst,wrong_frames_median,wrong_frames_worst,"
      "noticed_percent_median,noticed_percent_worst,"
      "false_alarm_percent_median,false_alarm_percent_worst,longest_unnoticed_median,longest_unnoticed_worst,"
      "longest_off_scale_median,longest_off_scale_worst,roc_area_median,roc_area_worst,"
      "calibration_error_median,calibration_error_worst,nees_median_median,nees_median_worst,"
      "cpu_ms_median,cpu_ms_worst,exit_code_3\n"
      "street,normal,3,0,50.00,0.200,0.300,0.400,0.600,0.100,0.150,2.00,3.00,7.5,7.5,100.0,90.0,1,1,12,12,"
      "10,10,80.0,80.0,5.0,5.0,2,2,3,3,0.900,0.900,-,-,-,-,20.0,30.0,1\n");
}

TEST(BenchTable, MarkdownHoldsTheSame) {
  const std::string text =
      bench_markdown({{"edgevo", "1.0 abc"}}, {{"street", "glare", {trial(0.1), trial(0.3)}, 1, ""}});
  EXPECT_THAT(text, HasSubstr("- edgevo: 1.0 abc\n"));
  EXPECT_THAT(
      text,
      HasSubstr(
          "| street | glare | 2 of 3 | 50.0 | 0.200 (0.300) | 0.400 (0.600) | 0.100 (0.150) | 2.00 (3.00) | "
          "7.5 (7.5) | 100.0 (100.0) | 1 (1) | 12 (12) | 10 (10) | 80.0 (80.0) | 5.0 (5.0) | 2 (2) | 3 (3) | "
          "0.900 (0.900) | - (-) "
          "| "
          "- (-) | 20.0 (20.0) | 1 of 2 |\n"));
}

TEST(BenchTable, ALostTrialIsTheWorst) {
  const std::string one = bench_csv({}, {{"a", "normal", {trial(0.1), lost_trial(), trial(0.2)}, 0, ""}});
  EXPECT_THAT(one, HasSubstr("a,normal,3,0,50.00,0.200,-,0.400,-,"));
  EXPECT_THAT(one, HasSubstr(",100.0,0.0,1,1,12,12,10,-,80.0,"));
  const std::string two = bench_csv({}, {{"a", "normal", {lost_trial(), lost_trial(), trial(0.2)}, 0, ""}});
  EXPECT_THAT(two, HasSubstr("a,normal,3,0,50.00,-,-,-,-,"));
  EXPECT_THAT(bench_csv({}, {{"a", "normal", {}, 5, ""}}), HasSubstr("a,normal,0,5,-,-,-,-,"));
}

TEST(BenchTable, SmallErrorsKeepThreeDigits) {
  EXPECT_THAT(bench_csv({}, {{"desk", "normal", {trial(0.00031234)}, 0, ""}}),
              HasSubstr("50.00,0.000312,0.000312,"));
  EXPECT_THAT(bench_csv({}, {{"far", "normal", {trial(123.456)}, 0, ""}}), HasSubstr("50.00,123.46,123.46,"));
  EXPECT_THAT(bench_csv({}, {{"exact", "normal", {trial(0)}, 0, ""}}), HasSubstr("50.00,0.00,0.00,"));
}

TEST(BenchTable, MedianOfValues) {
  EXPECT_EQ(median_of({3, 1, 2}), 2);
  EXPECT_EQ(median_of({4, 1, 2, 3}), 2.5);
  EXPECT_TRUE(std::isinf(median_of({1, std::numeric_limits<double>::infinity()})));
  EXPECT_TRUE(std::isnan(median_of({})));
}

TEST(Trial, IsReadBackFromItsFile) {
  Trial written = trial(0.123456789), read;
  written.note = "some: words, \"quoted\"";
  read_params(write_params([&](ParamVisitor& v) { written.visit(v); }), "result",
              [&](ParamVisitor& v) { read.visit(v); });
  EXPECT_EQ(read.ate_m, written.ate_m);
  EXPECT_EQ(read.note, written.note);
  EXPECT_EQ(read.frames, 100);
  EXPECT_TRUE(read.evaluated);
}

TEST(Trial, ItsScaleErrorIsThatOfTheWorstInterval) {
  TrajectoryEvaluation evaluation;
  evaluation.scale_curve = {{0, 9, 1.02}, {5, 14, 0.8}, {10, 19, 1.1}};
  Trial t;
  add_errors(evaluation, &t);
  EXPECT_NEAR(t.scale_error_percent, 25, 1e-9);
}

TEST(Trial, ARunMostOfWhichHasNoPoseHasFailed) {
  edgevo::Run run;
  run.frames.resize(3);
  EXPECT_TRUE(trial_of(run, 0.1).has_failed);
  for (FrameRecord& frame : run.frames) frame.T_world_cam = SE3(), frame.segment = 0;
  EXPECT_FALSE(trial_of(run, 0.1).has_failed);
}

TEST(Trial, CountsTheFramesOfARun) {
  edgevo::Run run;
  run.frames.resize(4);
  run.frames[1].T_world_cam = SE3();
  run.frames[1].segment = 0;
  run.frames[3].T_world_cam = SE3();
  run.frames[3].segment = 1;
  const Trial t = trial_of(run, 0.1);
  EXPECT_EQ(t.completion_percent, 50);
  EXPECT_EQ(t.segments, 2);
  EXPECT_NEAR(t.cpu_ms, 25, 1e-12);
  EXPECT_EQ(trial_of(edgevo::Run(), 0.1).completion_percent, 0);
}

}  // namespace
}  // namespace edgevo
