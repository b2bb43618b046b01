#include "edgevo/report/run_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "support/synthetic_run.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;

TEST(RunReport, ComparesWithGroundTruth) {
  const testing::SyntheticRun made = testing::synthetic_run();
  const test::TempFolder folder;
  std::string truth;
  for (const FrameRecord& f : made.run.frames) {
    if (!f.T_world_cam) continue;
    const Eigen::Vector3d p = 2.5 * f.T_world_cam->translation();
    truth += to_string(f.time);
    for (double v : {p.x(), p.y(), p.z(), 0.0, 0.0, 0.0, 1.0}) truth += ' ' + std::to_string(v);
    truth += '\n';
  }
  std::ofstream(folder / "truth.txt") << truth;
  RunInfo info;
  info.ground_truth_path = folder / "truth.txt";
  const std::string html = report_html({made.run, info, {}, {}, {}});
  EXPECT_THAT(html, HasSubstr("one unit of the run is 2.5000 m"));
  EXPECT_THAT(html, HasSubstr("0.000 m</b><span>ATE, Sim(3)"));
  EXPECT_THAT(html, HasSubstr("stroke-dasharray"));
}

TEST(RunReport, TellsWhichRulesCalledForKeyframes) {
  testing::SyntheticRun made = testing::synthetic_run();
  made.run.frames[5].keyframe_rule = "return";
  const std::string html = report_html({made.run, RunInfo(), {}, {}, {}});
  const std::string keyframes = std::to_string(made.run.keyframes.size());
  EXPECT_THAT(html, HasSubstr("<td>fast motion</td><td>" + keyframes + "</td><td>0</td>"));
  EXPECT_THAT(html, HasSubstr("<td>return</td><td>0</td><td>1</td>"));
}

}  // namespace
}  // namespace edgevo
