// SPDX-License-Identifier: BSD-3-Clause
// The whole study on a plane, and inputs that it refuses.
#include "edgevo/study/study.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/core/output_file.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "edgevo/study/study_report.h"
#include "support/plane_scene.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;

// A camera that moves past a textured plane.
class PlaneFrames : public ExactFrames {
 public:
  explicit PlaneFrames(int size) : size_(size) {}
  const Camera& camera() const override { return scene_.camera; }
  int size() const override { return size_; }
  std::string name() const override { return "plane"; }
  SE3 T_world_cam(int i) const override {
    return {Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.06 * i, 0.01 * i, 0.05 * i)};
  }
  ExactFrame load(int i) const override {
    const Pinhole p = scene_.camera.pinhole();
    ExactFrame frame{i, 0.1 * i, scene_.render(T_world_cam(i)), {}, T_world_cam(i)};
    for (int y = 0; y < p.height; ++y)
      for (int x = 0; x < p.width; ++x)
        frame.depth.push_back(depth_factor *
                              float(1 / scene_.idepth(T_world_cam(i), {double(x), double(y)})));
    return frame;
  }
  float depth_factor = 1;

 private:
  test::PlaneScene scene_;
  int size_;
};

StudyOptions small_study() {
  StudyOptions options;
  options.points = 150;
  options.pairs = 2;
  options.distance = 1;
  options.max_distance = 2;
  return options;
}

const StudyCell& cell(const StudyResult& r, const std::string& curve, const std::string& light,
                      const std::string& method, const std::string& setting) {
  for (const StudyCell& c : r.cells)
    if (c.curve == curve && c.light == light && c.method == method && c.setting == setting) return c;
  throw std::runtime_error("no such cell");
}

TEST(Study, EveryCurveHasItsSettings) {
  int done = 0;
  const StudyResult r = run_study(PlaneFrames(7), small_study(), [&](int d) { done = d; });
  EXPECT_EQ(done, 2);
  for (const char* light : {"normal", "changed"}) {
    for (const char* cost : {"gradient", "intensity", "census"}) {
      for (const char* k : {"0", "0.25", "0.5", "1", "2", "4", "max"})
        EXPECT_EQ(cell(r, "search_length", light, cost, k).samples.size(), 2u);
      for (const char* s : {"3", "5", "7", "9", "11", "adaptive"}) cell(r, "patch_size", light, cost, s);
    }
    for (const char* method : {"gradient", "edge_matches", "front_end", "lucas_kanade", "epipolar_flow"})
      for (const char* distance : {"1", "2"}) cell(r, "frame_distance", light, method, distance);
  }
  EXPECT_GT(r.median_flow_px_per_frame, 1);
}

TEST(Study, AnEasySceneIsSolved) {
  const StudyResult r = run_study(PlaneFrames(7), small_study());
  for (const char* method : {"gradient", "edge_matches", "lucas_kanade"})
    for (const StudySample& s : cell(r, "frame_distance", "normal", method, "2").samples) {
      EXPECT_FALSE(s.failed) << method;
      EXPECT_LT(s.drift_percent, 12) << method;  // of a step of 16 cm, 5 m before a plane
      EXPECT_GT(s.matches, 60) << method;
    }
  // A plane constrains an essential matrix less than a street does.
  for (const StudySample& s : cell(r, "frame_distance", "normal", "epipolar_flow", "2").samples)
    EXPECT_LT(s.drift_percent, 25);
  EXPECT_EQ(cell(r, "search_length", "normal", "gradient", "0").samples[0].photometric, 0);
  EXPECT_GT(cell(r, "search_length", "normal", "gradient", "max").samples[0].photometric, 10);
  EXPECT_FALSE(cell(r, "confidence", "normal", "gradient", "1").errors.empty());
}

// The plane's frames as a folder of Virtual KITTI 2.0.3 give the study the same frames, but for depth in
// whole centimetres.
TEST(Study, VirtualKittiFolders) {
  const test::TempFolder root;
  const PlaneFrames frames(6);
  const std::string folder = root / "Scene01/clone";
  std::string poses = "frame cameraID r1,1 ...\n",
              intrinsics = "frame cameraID K[0,0] K[1,1] K[0,2] K[1,2]\n";
  for (const char* part : {"/frames/rgb/Camera_0", "/frames/depth/Camera_0"})
    std::filesystem::create_directories(folder + part);
  for (int i = 0; i < frames.size(); ++i) {
    const ExactFrame frame = frames.load(i);
    cv::Mat depth(240, 320, CV_16U);
    for (int k = 0; k < 320 * 240; ++k)
      depth.at<uint16_t>(k / 320, k % 320) = uint16_t(std::lround(100 * double(frame.depth[size_t(k)])));
    const std::string digits = "0000" + std::to_string(i) + ".png";
    cv::imwrite(folder + "/frames/depth/Camera_0/depth_" + digits, depth);
    write_png(folder + "/frames/rgb/Camera_0/rgb_" + digits, frame.image);
    const Eigen::Vector3d t = frame.T_world_cam.inverse().translation();
    poses += std::to_string(i) + " 0 1 0 0 " + fixed(t.x(), 6) + " 0 1 0 " + fixed(t.y(), 6) + " 0 0 1 " +
             fixed(t.z(), 6) + " 0 0 0 1\n";
    intrinsics += std::to_string(i) + " 0 260 260 159.5 119.5\n";
  }
  write_file(folder + "/extrinsic.txt", poses);
  write_file(folder + "/intrinsic.txt", intrinsics);
  SourceOptions source;
  source.path = folder;
  const auto read = virtual_kitti_frames(source);
  EXPECT_EQ(read->load(3).image.pixels, frames.load(3).image.pixels);
  EXPECT_NEAR(read->load(3).depth[1234], frames.load(3).depth[1234], 0.006);
  const StudyResult r = run_study(*read, small_study());
  for (const StudySample& s : cell(r, "frame_distance", "normal", "gradient", "1").samples)
    EXPECT_LT(s.drift_percent, 15);
  std::filesystem::remove(folder + "/extrinsic.txt");
  EXPECT_THROW(virtual_kitti_frames(source), InputError) << "no poses";
  source.path = root.path();
  EXPECT_THROW(virtual_kitti_frames(source), InputError) << "no such folder";
}

TEST(Study, TheNumbersDependOnTheSeedAndNotOnThreads) {
  StudyOptions options = small_study();
  const auto first_drift = [&] {
    const StudyResult r = run_study(PlaneFrames(7), options);
    return cell(r, "frame_distance", "changed", "gradient", "2").samples[1].drift_percent;
  };
  options.threads = 1;
  const double one = first_drift();
  options.threads = 3;
  EXPECT_EQ(first_drift(), one);
  options.seed = 2;
  EXPECT_NE(first_drift(), one);
}

TEST(Study, TablesAndText) {
  const test::TempFolder folder;
  write_study(run_study(PlaneFrames(7), small_study()), folder / "out");
  for (const char* name :
       {"search_length.csv", "patch_size.csv", "frame_distance.csv", "residuals.csv", "variants.csv",
        "end_point_error.csv", "match_errors.csv", "confidence.csv", "confidence_areas.csv", "plots.gnuplot"})
    EXPECT_GT(std::filesystem::file_size(folder / (std::string("out/") + name)), 100u) << name;
  const std::string text = read_file(folder / "out/study.md", "");
  for (const char* number : {"### 1. ", "### 2. ", "### 3. ", "### 4. "})
    EXPECT_THAT(text, HasSubstr(number));
  int conclusions = 0;
  for (const char* words : {"**holds here**", "**holds here in part**", "**does not hold here**"})
    for (size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++conclusions;
  EXPECT_EQ(conclusions, 4);
}

TEST(Study, PlotsNeedAFolderWithAScript) {
  const test::TempFolder folder;
  EXPECT_FALSE(draw_plots(folder.path())) << "no script there";
  EXPECT_FALSE(draw_plots(folder / "none"));
}

std::string message_of(const ExactFrames& frames, const StudyOptions& options) {
  try {
    run_study(frames, options);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(Study, TooFewFramesAreReported) {
  EXPECT_THAT(message_of(PlaneFrames(4), small_study()), HasSubstr("needs 5 frames, there are 4"));
  StudyOptions options = small_study();
  options.end = 9;
  EXPECT_THAT(message_of(PlaneFrames(7), options), HasSubstr("frames 0:9 are not in it"));
}

TEST(Study, InvalidOptionsAreReported) {
  StudyOptions options = small_study();
  options.distance = 3;
  EXPECT_THAT(message_of(PlaneFrames(9), options),
              HasSubstr("distance 3: is more than the largest distance, 2"));
  options = small_study();
  options.light = "dark";
  EXPECT_THAT(message_of(PlaneFrames(9), options), HasSubstr("dark"));
}

TEST(Study, DepthThatContradictsThePosesIsReported) {
  PlaneFrames frames(7);
  frames.depth_factor = 0.1f;  // as if the unit were wrong
  EXPECT_THAT(message_of(frames, small_study()), HasSubstr("do not belong together"));
}

}  // namespace
}  // namespace edgevo
