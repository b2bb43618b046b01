// SPDX-License-Identifier: BSD-3-Clause
// Both releases of Virtual KITTI, from small folders written here.
#include "edgevo/datasets/virtual_kitti.h"

#include "edgevo/datasets/ground_truth.h"
#include "edgevo/datasets/open_source.h"
#include "virtual_kitti_folder.h"

namespace edgevo {
namespace {

using namespace test;
using ::testing::HasSubstr;

constexpr int kFrames = kVirtualKittiFrames;

SourceOptions from(const std::string& folder, const std::string& sensor = "") {
  SourceOptions options;
  options.path = folder;
  options.sensor_label = sensor;
  return options;
}

class VirtualKitti1 : public ::testing::Test {
 protected:
  VirtualKitti1() { write_virtual_kitti_1(root.path()); }
  TempFolder root;
  std::string sequence = root.path() + "/vkitti_1.3.1_rgb/0001/15-deg-left";
  std::string poses_path = root.path() + "/vkitti_1.3.1_extrinsicsgt/0001_15-deg-left.txt";
};

class VirtualKitti2 : public ::testing::Test {
 protected:
  VirtualKitti2() { write_virtual_kitti_2(sequence); }
  TempFolder root;
  std::string sequence = root.path() + "/Scene01/clone";
};

void expect_poses(const VirtualKitti& v, double baseline) {
  ASSERT_EQ(v.T_world_cam.size(), size_t(kFrames));
  for (int i = 0; i < kFrames; ++i) {
    const SE3 expected =
        virtual_kitti_pose(i) * SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(baseline, 0, 0));
    EXPECT_LT((v.T_world_cam[size_t(i)].matrix() - expected.matrix()).norm(), 1e-9);
  }
}

void expect_depth(const std::string& path) {
  const std::vector<float> depth = read_virtual_kitti_depth(path, 24, 16);
  EXPECT_FLOAT_EQ(depth[0], 5.00f);
  EXPECT_FLOAT_EQ(depth[25], 5.25f);
  EXPECT_EQ(depth.back(), 0) << "sky";
}

TEST_F(VirtualKitti1, IsRead) {
  ASSERT_TRUE(is_virtual_kitti(sequence));
  ASSERT_TRUE(is_virtual_kitti(sequence + "/"));
  const VirtualKitti v = read_virtual_kitti(from(sequence));
  EXPECT_EQ(v.release, "1.3.1");
  EXPECT_EQ(v.camera.pinhole().fx, 725);
  EXPECT_EQ(v.camera.pinhole().cx, 620.5);
  EXPECT_EQ(v.camera.pinhole().width, 24);
  EXPECT_EQ(v.times[2], Timestamp::from_seconds(0.2));
  expect_poses(v, 0);
  expect_depth(v.depths[1]);
}

TEST_F(VirtualKitti2, BothCamerasAreRead) {
  ASSERT_TRUE(is_virtual_kitti(sequence));
  for (int c = 0; c < 2; ++c) {
    SourceOptions options = from(sequence);
    if (c == 1) options.sensor_label = "Camera_1";
    const VirtualKitti v = read_virtual_kitti(options);
    EXPECT_EQ(v.release, "2.0.3");
    EXPECT_EQ(v.camera_name, "Camera_" + std::to_string(c));
    EXPECT_EQ(v.camera.pinhole().fx, 20.5);
    EXPECT_EQ(v.camera.pinhole().cx, 11 + c);
    EXPECT_EQ(v.camera.pinhole().width, 24);
    expect_poses(v, 0.5 * c);
    expect_depth(v.depths[0]);
  }
}

TEST_F(VirtualKitti2, ArchivesUnpackedApart) {
  const std::string apart = root.path() + "/vkitti_2.0.3_rgb/Scene01/clone";
  fs::create_directories(fs::path(apart).parent_path());
  fs::create_directories(apart + "/frames");
  fs::rename(sequence + "/frames/rgb", apart + "/frames/rgb");
  for (const char* archive : {"vkitti_2.0.3_depth", "vkitti_2.0.3_textgt"})
    fs::create_directories(root.path() + "/" + archive + "/Scene01");
  fs::create_directories(root.path() + "/vkitti_2.0.3_depth/Scene01/clone/frames");
  fs::rename(sequence + "/frames/depth", root.path() + "/vkitti_2.0.3_depth/Scene01/clone/frames/depth");
  fs::rename(sequence, root.path() + "/vkitti_2.0.3_textgt/Scene01/clone");
  const VirtualKitti v = read_virtual_kitti(from(apart));
  expect_poses(v, 0);
  expect_depth(v.depths[2]);
}

TEST_F(VirtualKitti1, PlaysAsASource) {
  const auto source = open_source(from(sequence));
  EXPECT_EQ(source->kind(), "Virtual KITTI 1.3.1");
  const auto frames = read_all(*source);
  ASSERT_EQ(frames.size(), size_t(kFrames));
  EXPECT_TRUE(same_pixels(frames[1].image, make_image(1)));
  const std::string truth = ground_truth_tum(from(sequence), *source);
  EXPECT_THAT(truth, HasSubstr("\n0.2000000 1.000000000 0.100000000 4.000000000 "));
}

TEST_F(VirtualKitti2, PlaysAsASource) {
  const auto source = open_source(from(sequence));
  EXPECT_EQ(source->kind(), "Virtual KITTI 2.0.3");
  EXPECT_EQ(read_all(*source).size(), size_t(kFrames));
  EXPECT_THAT(error_of([&] { open_source(from(sequence, "Camera_7")); }),
              HasSubstr("no camera 'Camera_7'; did you mean"));
}

TEST_F(VirtualKitti1, PlaysWithoutPosesAndDepth) {
  fs::remove(poses_path);
  fs::remove_all(root.path() + "/vkitti_1.3.1_depthgt");
  const auto source = open_source(from(sequence));
  EXPECT_EQ(read_all(*source).size(), size_t(kFrames));
  EXPECT_EQ(ground_truth_tum(from(sequence), *source), "");
}

TEST_F(VirtualKitti1, BadPosesAreReported) {
  const std::string good = read_text(poses_path);
  const auto message = [&](const std::string& text) {
    write_text(poses_path, text);
    return error_of([&] { read_virtual_kitti(from(sequence)); });
  };
  EXPECT_THAT(message(good.substr(0, good.rfind('\n', good.size() - 2) + 1)),
              HasSubstr("no pose of frame 2"));
  EXPECT_THAT(message("1 2 3\n"), HasSubstr("header line"));
  EXPECT_THAT(message(""), HasSubstr("header line"));
  EXPECT_THAT(message("frame x\n0 1 2 3\n"), HasSubstr("line 2"));
  EXPECT_THAT(message("frame x\n0 2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1\n"), HasSubstr("not a rigid motion"));
  EXPECT_THAT(message("frame x\n0 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 7\n"), HasSubstr("not a rigid motion"));
  EXPECT_THAT(message("frame x\n1e300 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n"), HasSubstr("no frame number"));
  EXPECT_THAT(message("frame x\n0 1 0 0 nan 0 1 0 0 0 0 1 0 0 0 0 1\n"), HasSubstr("nan"));
}

TEST_F(VirtualKitti2, AChangingCalibrationIsReported) {
  write_text(sequence + "/intrinsic.txt", "frame cameraID K\n0 0 20 20 12 8\n1 0 21 20 12 8\n");
  EXPECT_THAT(error_of([&] { read_virtual_kitti(from(sequence)); }),
              HasSubstr("line 3: the calibration changes"));
  write_text(sequence + "/intrinsic.txt", "frame cameraID K\n0 1 20 20 12 8\n");
  EXPECT_NE(error_of([&] { read_virtual_kitti(from(sequence)); }), "") << "none of camera 0";
}

TEST_F(VirtualKitti1, BadDepthIsReported) {
  const std::string path = root / "depth.png";
  EXPECT_THAT(error_of([&] { read_virtual_kitti_depth(path, 24, 16); }), HasSubstr("depth.png"));
  write_virtual_kitti_depth(path, 25, 16);
  EXPECT_THAT(error_of([&] { read_virtual_kitti_depth(path, 24, 16); }), HasSubstr("25 x 16"));
  write_png(path, make_image(1));
  EXPECT_THAT(error_of([&] { read_virtual_kitti_depth(path, 24, 16); }), HasSubstr("16 bits"));
  write_virtual_kitti_depth(path);
  fs::resize_file(path, fs::file_size(path) / 2);
  EXPECT_NE(error_of([&] { read_virtual_kitti_depth(path, 24, 16); }), "") << "cut short";
}

TEST_F(VirtualKitti1, NamesWithoutNumbersAreReported) {
  fs::rename(sequence + "/00001.png", sequence + "/one.png");
  EXPECT_THAT(error_of([&] { read_virtual_kitti(from(sequence)); }), HasSubstr("no frame number"));
}

TEST(VirtualKittiLayout, OtherFoldersAreNotRecognised) {
  const TempFolder root;
  fs::create_directories(root / "images");
  EXPECT_FALSE(is_virtual_kitti(root.path()));
  EXPECT_FALSE(is_virtual_kitti(root / "images"));
  EXPECT_FALSE(is_virtual_kitti("/"));
}

}  // namespace
}  // namespace edgevo
