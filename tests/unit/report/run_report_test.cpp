// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/report/run_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "support/synthetic_run.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// The true trajectory, 2.5 times as large as the run.
std::string truth_of(const Run& run) {
  std::string truth;
  for (const FrameRecord& f : run.frames) {
    if (!f.T_world_cam) continue;
    const Eigen::Vector3d p = 2.5 * f.T_world_cam->translation();
    const Eigen::Vector4d q = f.T_world_cam->rotation().coeffs();
    truth += to_string(f.time);
    for (double v : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}) truth += ' ' + std::to_string(v);
    truth += '\n';
  }
  return truth;
}

RunInfo info_with_truth(const Run& run, const test::TempFolder& folder) {
  std::ofstream(folder / "truth.txt") << truth_of(run);
  RunInfo info;
  info.ground_truth_path = folder / "truth.txt";
  return info;
}

TEST(RunReport, ComparesWithGroundTruth) {
  const test::SyntheticRun made = test::synthetic_run();
  const test::TempFolder folder;
  const RunInfo info = info_with_truth(made.run, folder);
  const std::string html = report_html({made.run, info, {}, {}, {}});
  EXPECT_THAT(html, HasSubstr("one unit of the run is 2.5000 m"));
  EXPECT_THAT(html, HasSubstr("0.000 m</b><span>ATE, Sim(3)"));
  EXPECT_THAT(html, HasSubstr("stroke-dasharray"));
}

TEST(RunReport, ShowsTheErrorOverTimeAndTheDriftByLength) {
  const test::SyntheticRun made = test::synthetic_run();
  const test::TempFolder folder;
  const std::string html = report_html({made.run, info_with_truth(made.run, folder), {}, {}, {}});
  EXPECT_THAT(html, HasSubstr("distance from the truth, m over time"));
  EXPECT_THAT(html, HasSubstr("Drift by length of the interval"));
  EXPECT_THAT(html, HasSubstr("<td>6.6 m</td>")) << "30 % of a path of 22 m";
  EXPECT_THAT(report_html({made.run, RunInfo(), {}, {}, {}}), Not(HasSubstr("Drift by length")));
}

TEST(RunReport, ShowsTheEpochsAndWhatRelatesThem) {
  test::SyntheticRun made = test::synthetic_run();
  EXPECT_THAT(report_html({made.run, RunInfo(), {}, {}, {}}), Not(HasSubstr("Units of length")));
  const int last = made.run.frames.back().index;
  made.run.epochs = {{0, 0, 0, 9, 1, 0}, {0, 1, 10, last, 1.25, 0.03}};
  made.run.constraints = {{"ground", 5, 12, 1.25, 0.028, true},
                          {"features", 6, 13, 0.5, 0.02, false},
                          {"place", 6, 14, 1, std::numeric_limits<double>::infinity(), true}};
  const std::string html = report_html({made.run, RunInfo(), {}, {}, {}});
  EXPECT_THAT(html, HasSubstr("Units of length"));
  EXPECT_THAT(html, HasSubstr("linked by ground"));
  EXPECT_THAT(html, HasSubstr("contradicted by the others"));
  EXPECT_THAT(html,
              HasSubstr("<td>10 to " + std::to_string(last) + "</td><td>0</td><td>1.250</td><td>3.0 %</td>"));
  EXPECT_THAT(html, HasSubstr("<td>features</td><td>6 to 13</td><td>0.500</td><td>2.0 %</td><td>no</td>"));
  EXPECT_THAT(html, HasSubstr("<td>place</td><td>6 to 14</td><td></td><td></td><td>yes</td>"));
}

TEST(RunReport, ShowsTheMapInTheUnitOfItsPath) {
  const test::SyntheticRun made = test::synthetic_run();
  const test::TempFolder folder;
  const std::vector<MapVertex> points = map_points(made.run, PointFilter());
  const std::string plain = report_html({made.run, RunInfo(), {}, {}, {}, {}, points});
  EXPECT_THAT(plain, HasSubstr("\"unit\":\"units\""));
  EXPECT_THAT(plain, HasSubstr(std::to_string(points.size()) + " vertices of the map."));
  const std::string metric =
      report_html({made.run, info_with_truth(made.run, folder), {}, {}, {}, {}, points});
  EXPECT_THAT(metric, HasSubstr("\"unit\":\"m\""));
  const auto sigma = [](const std::string& html) {
    return std::atof(html.c_str() + html.find("sigma_high") + 12);
  };
  EXPECT_NEAR(sigma(metric), 2.5 * sigma(plain), 1e-4);
}

TEST(RunReport, LinksToItsSections) {
  const test::SyntheticRun made = test::synthetic_run();
  const std::string html = report_html({made.run, RunInfo(), {}, {}, {}});
  for (const char* id :
       {"next", "trajectory", "space", "edges", "map", "states", "trust", "timing", "scale", "parameters"}) {
    EXPECT_THAT(html, HasSubstr("<a href=\"#" + std::string(id) + "\">"));
    EXPECT_THAT(html, HasSubstr("<section id=\"" + std::string(id) + "\">"));
  }
}

TEST(RunReport, ShowsTheMaskOfAPartThatIsFixedToTheCamera) {
  const test::SyntheticRun made = test::synthetic_run();
  RunInfo info;
  EXPECT_THAT(report_html({made.run, info, {}, {}, {}}), Not(HasSubstr("<section id=\"mask\">")));
  info.ego_mask = {40, 30, std::vector<uint8_t>(1200, 255)};
  std::fill_n(info.ego_mask.pixels.begin(), 300, uint8_t(0));
  const std::string html = report_html({made.run, info, {}, {}, {}});
  EXPECT_THAT(html, HasSubstr("<section id=\"mask\">"));
  EXPECT_THAT(html, HasSubstr("black, 25.0 % of the image"));
}

TEST(RunReport, ShowsTheTrustInEachFrameAndWhatSpeaksAgainstIt) {
  test::SyntheticRun made = test::synthetic_run();
  std::vector<FrameRecord>& frames = made.run.frames;
  for (FrameRecord& f : frames) f.p_right = 0.99, f.state = TrackingState::kTracking;
  EXPECT_THAT(report_html({made.run, RunInfo(), {}, {}, {}}), HasSubstr("No frame is doubtful."));
  for (size_t i = 8; i < 12; ++i) frames[i].p_right = 0.05, frames[i].note = "corners contradict the scale";
  const std::string html = report_html({made.run, RunInfo(), {}, {}, {}});
  EXPECT_THAT(html, HasSubstr("probability that the motion is right"));
  EXPECT_THAT(html,
              HasSubstr("<td>" + std::to_string(frames[8].index) + " to " + std::to_string(frames[11].index) +
                        "</td><td>4</td><td>corners contradict the scale</td>"));
}

TEST(RunReport, ShowsTheReasonsForKeyframes) {
  test::SyntheticRun made = test::synthetic_run();
  made.run.frames[5].keyframe_reason = KeyframeReason::kReturn;
  const std::string html = report_html({made.run, RunInfo(), {}, {}, {}});
  const std::string keyframes = std::to_string(made.run.keyframes.size());
  EXPECT_THAT(html, HasSubstr("<td>view leaves</td><td>" + keyframes + "</td><td>0</td>"));
  EXPECT_THAT(html, HasSubstr("<td>return</td><td>0</td><td>1</td>"));
}

}  // namespace
}  // namespace edgevo
