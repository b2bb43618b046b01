// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/run_outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <mrpt/containers/yaml.h>
#include <sys/mount.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include "edgevo/core/input_file.h"
#include "edgevo/occupancy/edge_ply_reader.h"
#include "run_files.h"
#include "written_run.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using mrpt::containers::yaml;
using test::content;
using test::lines_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

using RunOutputFolder = WrittenRun;

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

// Every file written is in the list of files, and every file of the list is in the README.
TEST_F(RunOutputFolder, EveryFileIsListedAndDocumented) {
  write(folder_, made_.run, made_.camera);
  std::set<std::string> listed, written;
  for (const RunFile& file : run_files()) listed.insert(file.name);
  for (const auto& entry : fs::directory_iterator(folder_)) written.insert(entry.path().filename().string());
  for (const std::string& name : written) EXPECT_TRUE(listed.count(name)) << name << " is not in run_files()";
  for (const char* optional : {"trajectory_vehicle_tum.txt", "scale.csv", "mask.png", "camera.yaml",
                               "edges_doubtful.ply", "run.mcap", "map.db"})
    written.insert(optional);
  for (const std::string& name : listed) EXPECT_TRUE(written.count(name)) << name << " was not written";
  const std::string readme = read_file(std::string(EDGEVO_SOURCE_DIR) + "/README.md", "");
  for (const std::string& name : listed)
    EXPECT_THAT(readme, HasSubstr('`' + name)) << "the table of a run's files";
}

TEST_F(RunOutputFolder, WritesEveryFile) {
  write(folder_ / "new/parents", made_.run, made_.camera);
  for (const char* file : kFiles) EXPECT_GT(content(folder_ / "new/parents" / file).size(), 100u) << file;
  EXPECT_TRUE(fs::exists(folder_ / "new/parents/playback_Images/frame_000044.png"));
}

// What was made in doubt lies next to the map, not in it; on request it is in it.
TEST_F(RunOutputFolder, TheMapsAreWithoutWhatIsDoubtful) {
  edgevo::Run run = made_.run;
  write(temp_ / "sure", run, made_.camera);
  EXPECT_FALSE(fs::exists(temp_ / "sure/edges_doubtful.ply"));
  run.keyframes.front().is_doubtful = true;
  write(temp_ / "doubtful", run, made_.camera);
  const size_t all = read_edge_ply(temp_ / "sure/edges.ply").keyframes[0].points.size();
  EXPECT_GT(all, 0u);
  EXPECT_EQ(read_edge_ply(temp_ / "doubtful/edges.ply").keyframes[0].points.size(), 0u);
  EXPECT_EQ(read_edge_ply(temp_ / "doubtful/edges_doubtful.ply").keyframes[0].points.size(), all);
  EXPECT_NE(content(temp_ / "sure/edges.ot"), content(temp_ / "doubtful/edges.ot"));
  EXPECT_THAT(content(temp_ / "doubtful/summary.yaml"), HasSubstr("keyframes_doubtful: 1"));
  OutputOptions options;
  options.include_doubtful = true;
  RunOutputs outputs(temp_ / "included", made_.camera, {}, options);
  for (const FrameRecord& frame : run.frames)
    ASSERT_TRUE(outputs.add_frame(test::synthetic_frame(made_.camera, frame)));
  RunInfo info;
  info.camera = made_.camera;
  outputs.finish(run, info);
  EXPECT_EQ(content(temp_ / "included/edges.ot"), content(temp_ / "sure/edges.ot"));
}

TEST_F(RunOutputFolder, SameRunSameBytes) {
  write(folder_ / "a", made_.run, made_.camera);
  write(folder_ / "b", made_.run, made_.camera);
  for (const char* file : kFiles) {
    if (std::string(file) == "summary.yaml") continue;
    EXPECT_EQ(content(folder_ / "a" / file), content(folder_ / "b" / file)) << file;
  }
}

TEST_F(RunOutputFolder, AnEmptyRunIsWrittenWithANote) {
  edgevo::Run run;
  run.pinhole = made_.run.pinhole;
  write(folder_, run, made_.camera);
  const yaml s = yaml::FromFile((folder_ / "summary.yaml").string());
  EXPECT_EQ(s["frames"]["total"].as<int>(), 0);
  EXPECT_THAT(s["map"]["note"].as<std::string>(), HasSubstr("valid but empty"));
}

TEST_F(RunOutputFolder, AFailedFileIsReportedAndTheOthersAreWritten) {
  RunOutputs outputs(folder_.string(), made_.camera, {});
  for (const FrameRecord& frame : made_.run.frames)
    ASSERT_TRUE(outputs.add_frame(test::synthetic_frame(made_.camera, frame)));
  fs::create_symlink("/dev/full", folder_ / "frames.csv");
  EXPECT_EQ(message_of([&] { outputs.finish(made_.run, {}); }),
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

TEST_F(RunOutputFolder, AThreadOfItsOwnWritesTheSameBytes) {
  const auto log = std::make_shared<MapLog>();
  OutputOptions options;
  for (const char* name : {"at_once", "later"}) {
    options.own_thread = std::string(name) == "later";
    RunOutputs outputs(folder_ / name, made_.camera, {}, options);
    outputs.keep_recovery_log({}, log);
    for (const FrameRecord& frame : made_.run.frames) {
      ASSERT_TRUE(outputs.add_frame(test::synthetic_frame(made_.camera, frame)));
      outputs.add_record(frame);
    }
    outputs.finish(made_.run, {});
  }
  for (const char* file : kFiles) {
    if (std::string(file) == "summary.yaml") continue;
    EXPECT_EQ(content(folder_ / "at_once" / file), content(folder_ / "later" / file)) << file;
  }
  EXPECT_EQ(content(folder_ / "at_once/playback_Images/frame_000044.png"),
            content(folder_ / "later/playback_Images/frame_000044.png"));
}

TEST_F(RunOutputFolder, AThreadOfItsOwnReportsAFailedImageLater) {
  OutputOptions options;
  options.own_thread = true;
  RunOutputs outputs(folder_.string(), made_.camera, {}, options);
  ASSERT_TRUE(outputs.add_frame(test::synthetic_frame(made_.camera, made_.run.frames[0])));
  fs::create_directories(folder_ / "playback_Images/frame_000003.png/in_the_way");
  int added = 0;
  for (const FrameRecord& frame : made_.run.frames)
    added += outputs.add_frame(test::synthetic_frame(made_.camera, frame));
  EXPECT_GE(added, 3);
  EXPECT_THAT(message_of([&] { outputs.finish(made_.run, {}); }),
              HasSubstr("frame_000003.png: cannot be written"));
  EXPECT_EQ(lines_of(content(folder_ / "frames.csv")).size(), 46u);
}

TEST_F(RunOutputFolder, AFailedImageEndsTheImagesButNotTheResults) {
  RunOutputs outputs(folder_.string(), made_.camera, {});
  ASSERT_TRUE(outputs.add_frame(test::synthetic_frame(made_.camera, made_.run.frames[0])));
  fs::create_directories(folder_ / "playback_Images/frame_000003.png/in_the_way");
  int added = 0;
  for (const FrameRecord& frame : made_.run.frames) {
    if (!outputs.add_frame(test::synthetic_frame(made_.camera, frame))) break;
    ++added;
  }
  EXPECT_EQ(added, 3);
  EXPECT_THAT(message_of([&] { outputs.finish(made_.run, {}); }),
              HasSubstr("frame_000003.png: cannot be written"));
  EXPECT_EQ(lines_of(content(folder_ / "frames.csv")).size(), 46u);
  EXPECT_GT(content(folder_ / "playback.rawlog").size(), 1000u);
}

TEST_F(RunOutputFolder, AFileAsOutputFolderIsRefused) {
  std::ofstream(folder_) << "a file";
  EXPECT_THAT(message_of([&] { RunOutputs(folder_.string(), made_.camera, {}); }), HasSubstr("is a file"));
  EXPECT_EQ(content(folder_), "a file");
}

TEST_F(RunOutputFolder, InvalidOccupancyParametersAreReportedBeforeTheRun) {
  MapParams map;
  map.occupancy.resolution = "fine";
  EXPECT_THAT(message_of([&] { RunOutputs(folder_.string(), made_.camera, map); }),
              HasSubstr("occupancy.resolution"));
  EXPECT_FALSE(fs::exists(folder_));
}

// On a small file system filled by images, the text files still fit. Needs the right to mount.
TEST_F(RunOutputFolder, AFullFileSystemKeepsTheTextFiles) {
  fs::create_directories(folder_);
  if (mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=6500k") != 0)
    GTEST_SKIP() << "NOT TESTED: a full file system (mount refused: " << std::strerror(errno)
                 << "); run as root with CAP_SYS_ADMIN. The other tests use /dev/full instead.";
  const std::string message = message_of([&] { write(folder_, made_.run, made_.camera); });
  const bool first_image = fs::exists(folder_ / "playback_Images/frame_000000.png");
  std::vector<std::string> lost;
  for (const char* file : {"trajectory_tum.txt", "trajectory_live_tum.txt", "trajectory_kitti.txt",
                           "frames.csv", "summary.yaml"})
    if (content(folder_ / file).empty()) lost.push_back(file);
  umount(folder_.c_str());
  EXPECT_THAT(message,
              HasSubstr("cannot be written: No space left on device; free space or give another -o"));
  EXPECT_TRUE(first_image);
  EXPECT_THAT(lost, ElementsAre());
}

}  // namespace
}  // namespace edgevo
