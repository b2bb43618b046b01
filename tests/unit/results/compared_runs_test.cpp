// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/compared_runs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "edgevo/results/finished_run.h"
#include "written_run.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ComparedRuns : public WrittenRun {
 protected:
  fs::path run_at(const std::string& name) {
    const fs::path folder = folder_ / name;
    write(folder, made_.run, made_.camera);
    return folder;
  }
  std::vector<ComparedRun> compared(const std::vector<std::string>& paths) {
    return compared_runs(paths, "", (temp_ / "page.html"));
  }
};

TEST_F(ComparedRuns, ReadsBackWhatARunWrote) {
  const FinishedRun run = read_finished_run(run_at("a").string());
  EXPECT_EQ(run.problem, "");
  EXPECT_EQ(run.frames, 45);
  EXPECT_EQ(run.lost, 5);
  EXPECT_EQ(run.segments, 2);
  EXPECT_EQ(run.keyframes, int(made_.run.keyframes.size()));
  EXPECT_EQ(run.trajectory.poses.size(), 40u);
  EXPECT_NEAR(run.cpu_ms, 4 + 0.1 * 22 + 2 + 20.0 * double(made_.run.keyframes.size()) / 45, 1e-3);
}

TEST_F(ComparedRuns, FindsEachRunBelowAFolderOnce) {
  run_at("b/two words");
  run_at("a");
  const std::vector<ComparedRun> rows = compared({folder_.string() + "/", (folder_ / "a").string()});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].name, "a");
  EXPECT_EQ(rows[1].name, "b/two words");
  EXPECT_EQ(rows[1].link, "out/b/two%20words/report.html");
}

TEST_F(ComparedRuns, AnIncompleteRunIsARowAmongOthers) {
  fs::remove(run_at("half") / "summary.yaml");
  std::ofstream(run_at("torn") / "trajectory_tum.txt") << "1 2 3\n";
  EXPECT_THAT(message_of([&] { compared({folder_.string()}); }), HasSubstr("half: cannot be compared: "));
  run_at("good");
  const std::vector<ComparedRun> rows = compared({folder_.string()});
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].problem, "");
  EXPECT_THAT(rows[1].problem, HasSubstr("is incomplete"));
  EXPECT_THAT(rows[2].problem, HasSubstr("trajectory_tum.txt:1"));
}

TEST_F(ComparedRuns, AFolderWithoutRunsIsRefused) {
  EXPECT_THAT(message_of([&] { compared({(temp_ / "nothing")}); }), HasSubstr("nothing: is not a folder"));
  fs::create_directories(folder_);
  EXPECT_THAT(message_of([&] { compared({folder_.string()}); }), HasSubstr("holds no results of a run"));
  EXPECT_THAT(message_of([&] { compared_runs({run_at("a").string()}, (temp_ / "no.txt"), "page.html"); }),
              HasSubstr("no.txt: cannot be read"));
}

}  // namespace
}  // namespace edgevo
