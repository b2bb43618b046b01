// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/frame_evaluation/frame_figures.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "made_run.h"

namespace edgevo {
namespace {

using test::made_run;
using test::MadeRun;
using ::testing::HasSubstr;

constexpr int kFrames = 2000, kBetweenFailures = 200, kReportedFor = 10;

bool is_wrong_step(int i) { return i % kBetweenFailures == kBetweenFailures - 1; }

// A run with a wrong step every 200 frames that knows it: p_right is low as long as one of the ten steps up
// to the frame is wrong.
MadeRun honest_run() {
  MadeRun made = made_run(test::winding_drive(kFrames), [](int i) { return is_wrong_step(i) ? 6 : 1; });
  for (int i = 0; i < kFrames; ++i) {
    double p = 0.99;
    for (int k = std::max(0, i - kReportedFor); k < i; ++k)
      if (is_wrong_step(k)) p = 0.02;
    made.reported[size_t(i)].p_right = p;
  }
  return made;
}

FrameFigures figures(const MadeRun& made) { return figures_of({evaluate_frames(made.reported, made.truth)}); }

// What a program must reach that is to be trusted.
bool passes(const FrameFigures& f) {
  return f.recall_percent.value_or(0) >= 90 && f.false_alarm_percent.value_or(100) <= 2 &&
         f.longest_unnoticed <= 15 && f.roc.value_or(0) >= 0.96 && f.calibration_error.value_or(1) <= 0.05;
}

TEST(FrameFigures, AProgramThatKnowsPasses) {
  const FrameFigures f = figures(honest_run());
  EXPECT_TRUE(passes(f));
  EXPECT_EQ(f.wrong, 10 * 9) << "ten motions for each failure";
  EXPECT_EQ(*f.recall_percent, 100);
  EXPECT_EQ(*f.false_alarm_percent, 0);
  EXPECT_NEAR(*f.roc, 1, 1e-9);
  EXPECT_LT(*f.calibration_error, 0.02);
  EXPECT_FALSE(f.is_roc_of_state);
}

TEST(FrameFigures, AConstantStatusFails) {
  MadeRun sure = honest_run(), unsure = honest_run();
  for (ReportedFrame& c : sure.reported) c.p_right = std::nan("");
  for (ReportedFrame& c : unsure.reported) c.p_right = std::nan(""), c.state = TrackingState::kDegraded;
  EXPECT_FALSE(passes(figures(sure)));
  EXPECT_EQ(*figures(sure).recall_percent, 0);
  EXPECT_EQ(figures(sure).longest_unnoticed, 10);
  EXPECT_FALSE(passes(figures(unsure)));
  EXPECT_EQ(*figures(unsure).false_alarm_percent, 100);
  for (const MadeRun* constant : {&sure, &unsure}) {
    EXPECT_EQ(*figures(*constant).roc, 0.5);
    EXPECT_TRUE(figures(*constant).is_roc_of_state);
    EXPECT_FALSE(figures(*constant).calibration_error);
  }
}

TEST(FrameFigures, AShuffledProbabilityFails) {
  MadeRun made = honest_run();
  Random random(8);
  for (size_t i = made.reported.size(); i-- > 1;)
    std::swap(made.reported[i].p_right, made.reported[size_t(random.below(int(i) + 1))].p_right);
  const FrameFigures f = figures(made);
  EXPECT_FALSE(passes(f));
  EXPECT_NEAR(*f.roc, 0.5, 0.1);
  EXPECT_GT(*f.false_alarm_percent, 2);
}

TEST(FrameFigures, AShiftedProbabilityFails) {
  MadeRun made = honest_run();
  for (size_t i = 0; i + 50 < made.reported.size(); ++i)
    made.reported[i].p_right = made.reported[i + 50].p_right;
  EXPECT_FALSE(passes(figures(made)));
}

TEST(FrameFigures, TooSureOrTooModestIsACalibrationError) {
  MadeRun made = made_run(test::winding_drive(500));
  for (ReportedFrame& c : made.reported) c.p_right = 0.8;
  EXPECT_NEAR(*figures(made).calibration_error, 0.2, 1e-9);
}

TEST(FrameFigures, PoolingCountsFramesAndKeepsTheWorstInterval) {
  const MadeRun honest = honest_run();
  MadeRun silent = honest;
  for (ReportedFrame& c : silent.reported) c.p_right = 0.99;
  const FrameFigures one = figures(honest), other = figures(silent),
                     both = figures_of({evaluate_frames(honest.reported, honest.truth),
                                        evaluate_frames(silent.reported, silent.truth)});
  EXPECT_EQ(both.runs, 2);
  EXPECT_EQ(both.wrong, one.wrong + other.wrong);
  EXPECT_EQ(*both.recall_percent, 50);
  EXPECT_EQ(both.longest_unnoticed, 10);
  EXPECT_NEAR(*both.roc, 0.75, 0.01);
}

TEST(FrameFigures, WhatDoesNotExistIsADashAndNull) {
  const std::vector<NamedFigures> rows{{"none", figures_of({})}};
  EXPECT_THAT(frame_figures_table(rows), HasSubstr("none"));
  const nlohmann::json json = nlohmann::json::parse(frame_figures_json(rows));
  EXPECT_TRUE(json[0]["recall_percent"].is_null());
  EXPECT_TRUE(json[0]["nees"].is_null());
  EXPECT_EQ(json[0]["evaluated"], 0);
  EXPECT_THAT(frame_figures_markdown(rows), HasSubstr("| none | 0 | 0 | - |"));
}

TEST(FrameFigures, SayHowManyFramesTheNoiseOfTheTruthHides) {
  FrameFigures figures;
  figures.frames = 300;
  figures.below_noise = 120;
  const TruthNoise noise{0.25, 0.02 * M_PI / 180};
  EXPECT_THAT(frame_section({{"live", figures}}, noise),
              HasSubstr("noise of the ground truth 250 mm, 0.02 deg, which hides 120 of 300 frames\n"));
  EXPECT_EQ(frame_members({{"live", figures}}, noise)[0].name, "truth_noise");
}

class ReportedFolder : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  void write(const char* name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  const std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) / ("reported_" + std::to_string(::getpid()));
};

TEST_F(ReportedFolder, IsReadByTheNamesOfItsColumns) {
  write("frames.csv",
        "index,time,state,p_right,segment,median_depth\n4,0.1,TRACKING,,0,5\n8,0.2,DEGRADED,0.25,0,\n"
        "12,0.3,LOST,,-1,\n");
  write("trajectory_tum.txt", "0.1 0 0 0 0 0 0 1\n0.2 0 0 1 0 0 0 1\n");
  std::string covariance = "index,reference";
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) covariance += ",c" + std::to_string(i) + std::to_string(j);
  covariance += "\n8,4";
  for (int k = 0; k < 21; ++k) covariance += "," + std::to_string(k) + "e-6";
  write("covariances.csv", covariance + "\n");
  const std::vector<ReportedFrame> reported = read_reported_frames(folder_.string(), PoseSource::kFinal);
  ASSERT_EQ(reported.size(), 3u);
  EXPECT_EQ(reported[0].median_depth, 5);
  EXPECT_TRUE(std::isnan(reported[0].p_right));
  EXPECT_EQ(reported[1].p_right, 0.25);
  EXPECT_EQ(reported[1].state, TrackingState::kDegraded);
  EXPECT_EQ(reported[1].T_world_cam->translation().z(), 1);
  EXPECT_EQ(reported[1].reference, 0);
  EXPECT_EQ(reported[1].covariance(1, 2), 7e-6);
  EXPECT_EQ(reported[1].covariance(5, 5), 20e-6);
  EXPECT_FALSE(reported[2].T_world_cam);
  EXPECT_THAT(test::input_error_of([&] { read_reported_frames(folder_.string(), PoseSource::kLive); }),
              HasSubstr("trajectory_live_tum.txt"));
}

TEST_F(ReportedFolder, DamageIsNamedWithItsLine) {
  write("trajectory_tum.txt", "# none\n");
  const auto error_of = [&](const std::string& text) {
    write("frames.csv", text);
    return test::input_error_of([&] { read_reported_frames(folder_.string(), PoseSource::kFinal); });
  };
  EXPECT_THAT(error_of(""), HasSubstr("is empty"));
  EXPECT_THAT(error_of("index,time\n"), "");
  EXPECT_THAT(error_of("index,time\n1,2\n"), HasSubstr("has no column state"));
  EXPECT_THAT(error_of("index,time,state,segment\n1,2,TRACK"), HasSubstr(":2: the line is incomplete"));
  EXPECT_THAT(error_of("index,time,state,segment\n1,2,TRACK,0\n"), HasSubstr("'TRACK' is no state"));
  EXPECT_THAT(error_of("index,time,state,segment\n1,x,LOST,0\n"), HasSubstr("time is not a number"));
}

}  // namespace
}  // namespace edgevo
