// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/report/compare_page.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "edgevo/evaluation/evaluate.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// A drive around a bend, with an error of `wave` metres.
Trajectory drive_with(double wave) {
  Trajectory t;
  for (int i = 0; i < 100; ++i)
    t.poses.push_back({Timestamp{16'700'000'000'000'000 + 1'000'000 * i},
                       SE3(Eigen::Quaterniond::Identity(),
                           Eigen::Vector3d(10 * std::sin(0.02 * i), wave * std::sin(0.5 * i), 0.5 * i))});
  return t;
}

std::string tum_of(const Trajectory& t) {
  std::string text;
  for (const StampedPose& p : t.poses) {
    const Eigen::Vector3d& v = p.T_world_cam.translation();
    text += to_string(p.time) + ' ' + std::to_string(v.x()) + ' ' + std::to_string(v.y()) + ' ' +
            std::to_string(v.z()) + " 0 0 0 1\n";
  }
  return text;
}

class ComparePage : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"truth.txt", "copy.txt"}) std::ofstream(folder_ / name) << tum_of(drive_with(0));
  }
  ComparedRun run(const std::string& name, double wave, const std::string& truth = "truth.txt") {
    ComparedRun r;
    r.name = name;
    r.frames = 100, r.keyframes = 20, r.segments = 1, r.cpu_ms = 12.5;
    if (!truth.empty()) r.ground_truth = folder_ / truth;
    r.trajectory = drive_with(wave);
    return r;
  }
  static size_t count(const std::string& html, const std::string& what) {
    size_t n = 0;
    for (size_t at = html.find(what); at != std::string::npos; at = html.find(what, at + 1)) ++n;
    return n;
  }

  test::TempFolder folder_;
};

TEST_F(ComparePage, TheWorstComesFirst) {
  ComparedRun corrupt = run("corrupt", 0), nowhere = run("nowhere", 0), unknown = run("unknown", 0.5, "");
  corrupt.problem = "it is <half> written";
  nowhere.trajectory.poses.clear();
  const std::string html = compare_html({run("good", 0.001), unknown, run("bad", 0.3), nowhere, corrupt});
  size_t last = 0;
  for (const char* name : {"corrupt", "nowhere", "bad", "good", "unknown"}) {
    const size_t at = html.find("data-value=\"" + std::string(name) + "\"");
    ASSERT_NE(at, std::string::npos) << name;
    EXPECT_GT(at, last) << name;
    last = at;
  }
  EXPECT_THAT(html, HasSubstr("it is &lt;half&gt; written"));
  EXPECT_THAT(html, HasSubstr("no frame has a pose"));
}

TEST_F(ComparePage, FiguresAreThoseOfEval) {
  const std::string html = compare_html({run("a", 0.3)});
  const double ate = evaluate(drive_with(0.3), drive_with(0), {}).ate_sim3.rmse;
  char text[32];
  std::snprintf(text, sizeof text, ">%.4f</td>", ate);
  EXPECT_THAT(html, HasSubstr(text));
}

TEST_F(ComparePage, PathsWithTheSameTruthAreOverlaid) {
  const std::string html = compare_html({run("a", 0.1), run("b", 0.2, "copy.txt"), run("c", 0.3, "")});
  EXPECT_THAT(html, HasSubstr("2 runs with one ground truth"));
  EXPECT_EQ(count(html, "<section"), 2u);
  EXPECT_EQ(count(html, "class=\"line\""), 3u) << "two paths and the truth";
  EXPECT_EQ(count(html, "<td class=\"small\"><svg"), 3u);
}

TEST_F(ComparePage, LinksAndMissingTruths) {
  ComparedRun linked = run("a", 0.1), lost = run("b", 0.1, "gone.txt");
  linked.link = "runs/a%20b/report.html";
  const std::string html = compare_html({linked, lost});
  EXPECT_THAT(html, HasSubstr("<a href=\"runs/a%20b/report.html\">a</a>"));
  EXPECT_THAT(html, HasSubstr("gone.txt: cannot be read"));
}

TEST_F(ComparePage, HundredsOfRunsMakeOnePage) {
  std::vector<ComparedRun> runs;
  for (int i = 0; i < 500; ++i) runs.push_back(run("run" + std::to_string(i), 0.001 * i));
  const std::string html = compare_html(runs);
  EXPECT_LT(html.size(), 3'000'000u);
  EXPECT_THAT(html, HasSubstr("Drawn are the 40 worst"));
  EXPECT_EQ(count(html, "class=\"line\""), 41u);
}

}  // namespace
}  // namespace edgevo
