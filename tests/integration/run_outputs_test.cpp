#include "edgevo/results/run_outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/containers/yaml.h>
#include <sys/mount.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "edgevo/drive/keeping_up.h"
#include "edgevo/report/chart.h"
#include "edgevo/report/latency_figures.h"
#include "edgevo/report/run_report.h"
#include "edgevo/results/run_text.h"
#include "edgevo/results/yaml_writer.h"
#include "support/temp_folder.h"
#include "synthetic_run.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using mrpt::containers::yaml;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const char* const kFiles[] = {"trajectory_tum.txt",
                              "trajectory_live_tum.txt",
                              "trajectory_kitti.txt",
                              "frames.csv",
                              "edges.ply",
                              "edges.bt",
                              "edges.ot",
                              "keyframes.simplemap",
                              "playback.rawlog",
                              "scene.3Dscene",
                              "report.html",
                              "summary.yaml"};

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells(1);
  for (char c : row)
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  return cells;
}

class RunOutputsTest : public ::testing::Test {
 protected:
  static void write(const fs::path& folder, const edgevo::Run& run, const Camera& camera) {
    RunOutputs outputs(folder.string(), camera, {});
    for (const FrameRecord& frame : run.frames)
      if (!outputs.add_frame(testing::synthetic_frame(camera, frame))) break;
    RunInfo info;
    info.command_line = {"edgevo", "run", "a \"quoted\" folder"};
    info.source_kind = "synthetic";
    info.camera = camera;
    info.params_yaml = "edges:\n  percentile: 0.9\nseed: 3\n";
    info.notes = {{"bootstrap", "took 4 frames: not enough parallax"}};
    outputs.finish(run, info);
  }
  static std::string message_of(const std::function<void()>& work) {
    try {
      work();
    } catch (const InputError& e) {
      return e.what();
    }
    return "no InputError";
  }

  test::TempFolder temp_;
  const fs::path folder_ = temp_ / "out";  // not there yet
  const testing::SyntheticRun made_ = testing::synthetic_run();
};

TEST_F(RunOutputsTest, WritesEveryFile) {
  write(folder_ / "new/parents", made_.run, made_.camera);
  for (const char* file : kFiles) EXPECT_GT(content(folder_ / "new/parents" / file).size(), 100u) << file;
  EXPECT_TRUE(fs::exists(folder_ / "new/parents/playback_Images/frame_000044.png"));
}

TEST_F(RunOutputsTest, SameRunSameBytes) {
  write(folder_ / "a", made_.run, made_.camera);
  write(folder_ / "b", made_.run, made_.camera);
  for (const char* file : kFiles) {
    if (std::string(file) == "summary.yaml") continue;
    EXPECT_EQ(content(folder_ / "a" / file), content(folder_ / "b" / file)) << file;
  }
}

TEST_F(RunOutputsTest, SummaryIsYamlWithTheCounts) {
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

TEST_F(RunOutputsTest, FramesCsvHasARowForEveryFrameAndTimesLast) {
  const auto rows = lines_of(frames_csv(made_.run));
  ASSERT_EQ(rows.size(), 46u);
  EXPECT_EQ(
      rows[0],
      "index,time,state,segment,keyframe,inlier_share,residual_px,edges,note,keyframe_rule,latency_ms,ms_edges,ms_alignment,ms_ba");
  EXPECT_EQ(rows[2], "1,1670000000.1000000,BOOTSTRAPPING,0,0,0.8000,0.5000,1001,,,,4.100,2.000,");
  EXPECT_EQ(rows[21],
            "20,1670000002.0000000,LOST,-1,0,0.0000,0.0000,1020,lost: 3 of 400 points aligned; 120 "
            "needed,,,6.000,2.000,");
  EXPECT_EQ(rows[46 - 3], "42,1670000004.2000000,TRACKING,1,1,0.8000,0.5000,1042,,fast motion,,8.200,2.000,20.000");
  for (const std::string& row : rows) EXPECT_EQ(cells_of(row).size(), 14u) << row;
}

// Of 45 frames, the one with index i has its pose 10 + i ms after it was due; every tenth is handed over 2 ms late, and frame 20 never.
edgevo::Run kept_up(edgevo::Run run) {
  KeepingUp keeping_up("30 frames a second");
  for (int i = 0; i < 45; ++i) {
    const double due_s = 100 + i / 30.0;
    if (i == 20)
      keeping_up.note_dropped();
    else
      keeping_up.note_done(due_s, due_s + (i % 10 == 0 ? 2e-3 : 1e-4), due_s + 1e-3 * (10 + i));
  }
  run.realtime = RealtimeRecord();
  run.realtime->left_out_of_mapping = 7;
  keeping_up.write_to(&run);
  return run;
}

TEST_F(RunOutputsTest, LatencyOfARealtimeRun) {
  const edgevo::Run run = kept_up(made_.run);
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
  EXPECT_THAT(content(folder_ / "report.html"), HasSubstr("95 % 52.0, 99 % 54.0, max 54.0; 4 of 44 frames handed over late, 1 dropped"));
}

TEST_F(RunOutputsTest, ASynchronousRunHasNoLatency) {
  EXPECT_EQ(latency_statement(made_.run), "");
  EXPECT_FALSE(latency_figures(made_.run));
  write(folder_, made_.run, made_.camera);
  EXPECT_THAT(content(folder_ / "summary.yaml"), ::testing::Not(HasSubstr("realtime")));
}

TEST_F(RunOutputsTest, ReportShowsTheRun) {
  write(folder_, made_.run, made_.camera);
  const std::string html = content(folder_ / "report.html");
  const auto count = [&](const std::string& what) {
    int n = 0;
    for (size_t at = html.find(what); at != std::string::npos; at = html.find(what, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("<img alt="), 7);  // six with edges, the grid
  EXPECT_EQ(count("<svg"), 9);  // from above, three over time, ribbon, three of tracking, stages
  EXPECT_EQ(count("</svg>"), count("<svg"));
  EXPECT_THAT(html, HasSubstr("grid.yaml from above"));
  EXPECT_THAT(html, HasSubstr("occupied voxels"));
  EXPECT_THAT(html, HasSubstr("LOST 5"));
  EXPECT_THAT(html, HasSubstr("lost: 3 of 400 points aligned, 120 needed"));
  EXPECT_THAT(html, HasSubstr("percentile: 0.9"));
  EXPECT_THAT(html, HasSubstr("edgevo run a &quot;quoted&quot; folder"));
  EXPECT_THAT(html, HasSubstr("No ground truth is known"));
}

TEST_F(RunOutputsTest, ReportComparesWithGroundTruth) {
  std::string truth;
  for (const FrameRecord& f : made_.run.frames) {
    if (!f.T_world_cam) continue;
    const Eigen::Vector3d p = 2.5 * f.T_world_cam->translation();
    truth += to_string(f.time);
    for (double v : {p.x(), p.y(), p.z(), 0.0, 0.0, 0.0, 1.0}) truth += ' ' + std::to_string(v);
    truth += '\n';
  }
  fs::create_directories(folder_);
  std::ofstream(folder_ / "truth.txt") << truth;
  RunInfo info;
  info.ground_truth_path = (folder_ / "truth.txt").string();
  const std::string html = report_html({made_.run, info, {}, {}, {}});
  EXPECT_THAT(html, HasSubstr("one unit of the run is 2.5000 m"));
  EXPECT_THAT(html, HasSubstr("0.000 m</b><span>ATE, Sim(3)"));
  EXPECT_THAT(html, HasSubstr("stroke-dasharray"));
}

TEST(ReportTicks, AreRoundAndInside) {
  EXPECT_THAT(nice_ticks(0, 10, 5), ElementsAre(0, 2, 4, 6, 8, 10));
  EXPECT_THAT(nice_ticks(0.013, 0.047, 3), ElementsAre(::testing::DoubleNear(0.02, 1e-12), ::testing::DoubleNear(0.04, 1e-12)));
  EXPECT_TRUE(nice_ticks(1, 1, 5).empty());
}

TEST(ReportCharts, GapsAndLongSeries) {
  TimeChart chart;
  chart.y_name = "a < b";
  Series s{"s", "#000000", {}};
  for (int i = 0; i < 5000; ++i) {
    chart.x.push_back(0.1 * i);
    s.y.push_back(i > 2000 && i < 3000 ? std::nan("") : std::sin(0.01 * i));
  }
  chart.series = {s};
  const std::string svg = draw(chart);
  EXPECT_LT(svg.size(), 30000u);
  EXPECT_THAT(svg, HasSubstr("a &lt; b"));
  EXPECT_THAT(svg, ::testing::Not(HasSubstr("nan")));
  const size_t line = svg.find("class=\"line\"");
  EXPECT_EQ(std::count(svg.begin() + std::ptrdiff_t(line), svg.end(), 'M'), 2) << "one gap, two pieces";
}

TEST_F(RunOutputsTest, TumTrajectoriesHoldTheFramesThatHavePoses) {
  const auto final_lines = lines_of(trajectory_tum(made_.run, PoseKind::kFinal));
  const auto live_lines = lines_of(trajectory_tum(made_.run, PoseKind::kLive));
  EXPECT_EQ(final_lines.size(), 4u + 40);
  EXPECT_EQ(live_lines.size(), 4u + 36);
  EXPECT_THAT(final_lines[0], StartsWith("# edgevo: T_world_cam"));
  EXPECT_THAT(final_lines[2], StartsWith("# unit: arbitrary"));
  EXPECT_EQ(final_lines[4],
            "1670000000.0000000 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 "
            "1.000000000");
}

TEST_F(RunOutputsTest, TumQuaternionsHaveAPositiveW) {
  edgevo::Run run;
  run.frames.resize(1);
  run.frames[0].T_world_cam = SE3(Eigen::Quaterniond(-0.8, 0.6, 0, 0), Eigen::Vector3d(1, -2, 3));
  EXPECT_EQ(
      lines_of(trajectory_tum(run, PoseKind::kFinal))[4],
      "0.0000000 1.000000000 -2.000000000 3.000000000 -0.600000000 0.000000000 0.000000000 0.800000000");
}

TEST_F(RunOutputsTest, KittiTrajectoryStandsStillWhereThereIsNoPose) {
  const auto rows = lines_of(trajectory_kitti(made_.run));
  ASSERT_EQ(rows.size(), 45u);
  for (int i = 20; i < 25; ++i) EXPECT_EQ(rows[size_t(i)], rows[19]);
  EXPECT_NE(rows[25], rows[24]);
  edgevo::Run late;
  late.frames.resize(2);
  EXPECT_THAT(lines_of(trajectory_kitti(late))[0],
              StartsWith("1.000000000 0.000000000 0.000000000 0.000000000 0.000000000 1.0"));
}

TEST_F(RunOutputsTest, EmptyRunIsWrittenWithANote) {
  edgevo::Run run;
  run.pinhole = made_.run.pinhole;
  write(folder_, run, made_.camera);
  const yaml s = yaml::FromFile((folder_ / "summary.yaml").string());
  EXPECT_EQ(s["frames"]["total"].as<int>(), 0);
  EXPECT_THAT(s["map"]["note"].as<std::string>(), HasSubstr("valid but empty"));
}

TEST_F(RunOutputsTest, OneFullFileIsToldAndTheOthersAreWritten) {
  fs::create_directories(folder_);
  fs::create_symlink("/dev/full", folder_ / "frames.csv");
  EXPECT_EQ(message_of([&] { write(folder_, made_.run, made_.camera); }),
            (folder_ / "frames.csv").string() +
                ": cannot be written: No space left on device; free space or give another -o; what was "
                "written so far is kept");
  const yaml s = yaml::FromFile((folder_ / "summary.yaml").string());
  EXPECT_EQ(s["not_written"].asSequence().size(), 1u);
  EXPECT_EQ(s["not_written"](0).as<std::string>(), "frames.csv");
  for (const char* file : kFiles) {
    if (std::string(file) == "frames.csv") continue;
    EXPECT_GT(content(folder_ / file).size(), 100u) << file;
  }
}

TEST_F(RunOutputsTest, ImageThatCannotBeWrittenEndsTheImagesButNotTheResults) {
  fs::create_directories(folder_ / "playback_Images/frame_000003.png/in_the_way");
  RunOutputs outputs(folder_.string(), made_.camera, {});
  int added = 0;
  for (const FrameRecord& frame : made_.run.frames) {
    if (!outputs.add_frame(testing::synthetic_frame(made_.camera, frame))) break;
    ++added;
  }
  EXPECT_EQ(added, 3);
  EXPECT_THAT(message_of([&] { outputs.finish(made_.run, {}); }),
              HasSubstr("frame_000003.png: cannot be written"));
  EXPECT_EQ(lines_of(content(folder_ / "frames.csv")).size(), 46u);
  EXPECT_GT(content(folder_ / "playback.rawlog").size(), 1000u);
}

TEST_F(RunOutputsTest, OutputFolderThatIsAFileIsRefused) {
  std::ofstream(folder_) << "a file";
  EXPECT_THAT(message_of([&] { RunOutputs(folder_.string(), made_.camera, {}); }), HasSubstr("is a file"));
  EXPECT_EQ(content(folder_), "a file");
}

TEST_F(RunOutputsTest, WrongOccupancyParametersAreToldBeforeTheRun) {
  MapParams map;
  map.occupancy.resolution = "fine";
  EXPECT_THAT(message_of([&] { RunOutputs(folder_.string(), made_.camera, map); }),
              HasSubstr("occupancy.resolution"));
  EXPECT_FALSE(fs::exists(folder_));
}

// A small file system: the images fill it, and yet the text files have their room. Needs the right to mount.
TEST_F(RunOutputsTest, FullFileSystemKeepsWhatFitted) {
  fs::create_directories(folder_);
  if (mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=6500k") != 0)
    GTEST_SKIP() << "NOT TESTED: a full file system (mount refused: " << std::strerror(errno)
                 << "); run as root with CAP_SYS_ADMIN. /dev/full stands in for it in the other tests.";
  const std::string message = message_of([&] { write(folder_, made_.run, made_.camera); });
  const bool first_image = fs::exists(folder_ / "playback_Images/frame_000000.png");
  std::vector<std::string> lost;
  for (const char* file : {"trajectory_tum.txt", "trajectory_live_tum.txt", "trajectory_kitti.txt", "frames.csv", "summary.yaml"})
    if (content(folder_ / file).empty()) lost.push_back(file);
  umount(folder_.c_str());
  EXPECT_THAT(message,
              HasSubstr("cannot be written: No space left on device; free space or give another -o"));
  EXPECT_TRUE(first_image);
  EXPECT_THAT(lost, ElementsAre());
}

TEST(YamlQuoted, SurvivesAnyText) {
  const std::string nasty = "a \"b\" \\c: #d\n- {e}";
  EXPECT_EQ(yaml::FromText("key: " + yaml_quoted(nasty))["key"].as<std::string>(), nasty);
}

}  // namespace
}  // namespace edgevo
