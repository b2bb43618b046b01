// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <mrpt/containers/yaml.h>
#include <cmath>

#include "edgevo/results/run_text.h"
#include "edgevo/results/yaml_writer.h"
#include "edgevo/run_loop/latency_stats.h"
#include "edgevo/run_quality/run_statistics.h"
#include "written_run.h"

namespace edgevo {
namespace {

using mrpt::containers::yaml;
using test::cells_of;
using test::content;
using test::lines_of;
using ::testing::HasSubstr;

using Summary = WrittenRun;

TEST_F(Summary, SummaryIsYamlWithTheCounts) {
  write(folder_, made_.run, made_.camera);
  const yaml s = yaml::FromFile((folder_ / "summary.yaml").string());
  EXPECT_EQ(s["command"].as<std::string>(), "edgevo run a \"quoted\" folder");
  EXPECT_EQ(s["frames"]["total"].as<int>(), 45);
  EXPECT_EQ(s["frames"]["lost"].as<int>(), 5);
  EXPECT_EQ(s["frames"]["bootstrapping"].as<int>(), 4);
  EXPECT_EQ(s["frames"]["tracking"].as<int>(), 36);
  EXPECT_NEAR(s["frames"]["coverage"].as<double>(), 40.0 / 45, 1e-4);
  EXPECT_EQ(s["trajectory"]["segments"].as<int>(), 2);
  EXPECT_EQ(s["trajectory"]["keyframes"].as<int>(), int(made_.run.keyframes.size()));
  EXPECT_EQ(s["map"]["points"].as<int>(), 400 * int(made_.run.keyframes.size()));
  EXPECT_GT(s["map"]["points_exported"].as<int>(), 1000);
  EXPECT_GT(s["map"]["voxels_occupied"].as<int>(), 100);
  EXPECT_FALSE(s["scale"]["metric"].as<bool>());
  EXPECT_NEAR(s["timing"]["stages_ms"]["edges"]["median"].as<double>(), 6.2, 1e-6);  // of 4.0, 4.1, ... 8.4
  EXPECT_NEAR(s["timing"]["stages_ms"]["edges"]["max"].as<double>(), 8.4, 1e-6);
  EXPECT_NEAR(s["timing"]["stages_ms"]["edges"]["p95"].as<double>(), 8.2, 1e-6);  // the 43rd of 45
  EXPECT_EQ(s["timing"]["stages_ms"]["ba"]["frames"].as<int>(), int(made_.run.keyframes.size()));
  EXPECT_GT(s["memory"]["peak_mb"].as<double>(), 1);
  EXPECT_GT(s["timing"]["cpu_ms_per_frame"].as<double>(), 0);
  EXPECT_EQ(s["parameters"]["edges"]["percentile"].as<double>(), 0.9);
  EXPECT_EQ(s["parameters"]["seed"].as<int>(), 3);
  EXPECT_EQ(s["camera"]["k1"].as<double>(), -0.05);
  EXPECT_FALSE(s["edgevo"]["git"].as<std::string>().empty());
  EXPECT_NE(s["libraries"]["octomap"].as<std::string>(), "none");
}

// Of 45 frames, frame i has its pose 10 + i ms after it was due. Every tenth frame is delivered 2 ms late,
// and frame 20 is dropped.
edgevo::Run with_latency(edgevo::Run run) {
  LatencyStats latency("30 frames a second");
  for (int i = 0; i < 45; ++i) {
    const double due_s = 100 + i / 30.0;
    if (i == 20)
      latency.note_dropped();
    else
      latency.note_done(due_s, due_s + (i % 10 == 0 ? 2e-3 : 1e-4), due_s + 1e-3 * (10 + i));
  }
  run.realtime = RealtimeRecord();
  run.realtime->skipped_by_mapping = 7;
  latency.write_to(&run);
  return run;
}

TEST_F(Summary, LatencyOfARealtimeRun) {
  const edgevo::Run run = with_latency(made_.run);
  write(folder_, run, made_.camera);
  const yaml s = yaml::FromFile((folder_ / "summary.yaml").string());
  EXPECT_EQ(s["realtime"]["pace"].as<std::string>(), "30 frames a second");
  EXPECT_EQ(s["realtime"]["handed_over"].as<int>(), 44);
  EXPECT_EQ(s["realtime"]["late"].as<int>(), 4);  // 0, 10, 30, 40
  EXPECT_EQ(s["realtime"]["dropped"].as<int>(), 1);
  EXPECT_EQ(s["realtime"]["left_out_of_mapping"].as<int>(), 7);
  EXPECT_NEAR(s["realtime"]["frames_per_second"].as<double>(), 44 / (44 / 30.0 + 0.054), 1e-3);
  EXPECT_NEAR(s["realtime"]["latency_ms"]["p50"].as<double>(), 32, 1e-6);  // the 22nd of 44, without frame 20
  EXPECT_NEAR(s["realtime"]["latency_ms"]["p95"].as<double>(), 52, 1e-6);  // the 42nd
  EXPECT_NEAR(s["realtime"]["latency_ms"]["p99"].as<double>(), 54, 1e-6);  // the 44th
  EXPECT_NEAR(s["realtime"]["latency_ms"]["max"].as<double>(), 54, 1e-6);
  const auto rows = lines_of(frames_csv(run));
  EXPECT_EQ(cells_of(rows[0])[10], "latency_ms");
  EXPECT_EQ(cells_of(rows[1 + 3])[10], "13.000");
  EXPECT_EQ(cells_of(rows[1 + 20])[10], "");
  EXPECT_THAT(content(folder_ / "report.html"),
              HasSubstr("95 % 52.0, 99 % 54.0, max 54.0; 4 of 44 frames delivered late, 1 dropped"));
}

TEST_F(Summary, ASynchronousRunHasNoLatency) {
  EXPECT_EQ(latency_statement(made_.run), "");
  EXPECT_FALSE(latency_figures(made_.run));
  write(folder_, made_.run, made_.camera);
  EXPECT_THAT(content(folder_ / "summary.yaml"), ::testing::Not(HasSubstr("realtime")));
}

TEST_F(Summary, SaysWhichErrorOfTheFocalLengthMayNotShow) {
  edgevo::Run run = made_.run;
  run.camera.whole.keyframes = 60;
  run.camera.whole.set(CameraNumber::kFocal, 0.008, std::sqrt(0.007 * 0.007 - 0.004 * 0.004));
  write(folder_, run, made_.camera);
  EXPECT_THAT(content(folder_ / "summary.yaml"),
              HasSubstr("to three standard deviations, 2.1 %; a smaller error may not show"));
}

TEST_F(Summary, NamesTheFocalLengthThatWasApplied) {
  edgevo::Run run = made_.run;
  run.camera.is_sought[size_t(CameraNumber::kFocal)] = true;
  run.camera.corners = {0.22, 0.05, 5, 0};
  run.camera.applied.focal = 0.21;
  write(folder_, run, made_.camera);
  const std::string summary = content(folder_ / "summary.yaml");
  for (const char* line :
       {"focal: \"applied\"", "residual_focal: 0.21", "focal_estimate: 0.22", "focal_windows: 5"})
    EXPECT_THAT(summary, HasSubstr(line));
}

TEST(YamlQuoted, SurvivesAnyText) {
  const std::string nasty = "a \"b\" \\c: #d\n- {e}";
  EXPECT_EQ(yaml::FromText("key: " + yaml_quoted(nasty))["key"].as<std::string>(), nasty);
}

}  // namespace
}  // namespace edgevo
