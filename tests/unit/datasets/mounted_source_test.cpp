// SPDX-License-Identifier: BSD-3-Clause
// A mount that the user gives, on the command line or in the camera file.
#include "mounted_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "edgevo/core/error.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/datasets/open_source.h"
#include "support/temp_folder.h"
#include "temp_sequence.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;

class MountOnly : public ImageSource {
 public:
  explicit MountOnly(std::optional<SE3> mount) : mount_(std::move(mount)) {}
  const Camera& camera() const override { return camera_; }
  std::optional<SE3> T_vehicle_cam() const override { return mount_; }
  std::optional<int> size() const override { return 7; }
  std::string kind() const override { return "made"; }
  std::optional<Frame> next() override { return std::nullopt; }
  std::vector<InputDecision> decisions() const override { return {{"rate", "10 Hz", "", ""}}; }

 private:
  Camera camera_;
  std::optional<SE3> mount_;
};

TEST(MountedSource, HasTheMountAndSaysWhereItIsFrom) {
  const auto source =
      mount_source(std::make_unique<MountOnly>(std::nullopt), parse_camera_mount("0,20,0", ""), "--mount");
  EXPECT_NEAR(source->T_vehicle_cam()->R()(2, 2), -std::sin(20 * 3.14159265358979 / 180), 1e-9);
  EXPECT_EQ(source->size(), 7);
  ASSERT_EQ(source->decisions().size(), 2u);
  EXPECT_EQ(to_string(source->decisions()[1]),
            "mount: looks 20.0 degrees down and 0.0 to the left, turned 0.0 clockwise (--mount)");
}

TEST(MountedSource, SaysThatTheMountOfTheSourceIsNotUsed) {
  const SE3 own = T_vehicle_cam(parse_camera_mount("0,-5,0", ""));
  const auto source =
      mount_source(std::make_unique<MountOnly>(own), parse_camera_mount("0,20,0", ""), "--mount");
  EXPECT_THAT(source->decisions()[1].reason,
              HasSubstr("that of the source, which looks 5.0 degrees up and 0.0 to the left, turned 0.0 "
                        "clockwise, is not used"));
  const auto same = mount_source(std::make_unique<MountOnly>(own), parse_camera_mount("0,-5,0", ""), "x");
  EXPECT_EQ(same->decisions()[1].reason, "x");
}

Camera some_camera() { return Camera(Pinhole{500, 500, 320, 240, 640, 480}, Distortion{}); }

TEST(CameraFileMount, IsReadAsItIsWritten) {
  test::TempFolder folder;
  const CameraMount mount = parse_camera_mount("1.5,-20,90,0.3,-0.1,1.2", "");
  test::write_text(folder / "c.yaml", camera_yaml(some_camera(), "", mount));
  EXPECT_EQ(read_camera_file(folder / "c.yaml").pinhole().fx, 500);
  const auto back = read_camera_mount(folder / "c.yaml");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->roll_deg, 1.5);
  EXPECT_EQ(back->pitch_deg, -20);
  EXPECT_EQ(back->yaw_deg, 90);
  EXPECT_EQ(back->position, Eigen::Vector3d(0.3, -0.1, 1.2));
}

TEST(CameraFileMount, MayBeMissingOrHoldAnglesOnly) {
  test::TempFolder folder;
  test::write_text(folder / "none.yaml", camera_yaml(some_camera(), ""));
  EXPECT_FALSE(read_camera_mount(folder / "none.yaml"));
  test::write_text(folder / "none.txt", "500 500 320 240 0 0 0 0 640 480\n");
  EXPECT_FALSE(read_camera_mount(folder / "none.txt"));
  test::write_text(folder / "three.yaml", camera_yaml(some_camera(), "") + "mount: [0, 20, 0]\n");
  EXPECT_EQ(read_camera_mount(folder / "three.yaml")->pitch_deg, 20);
}

TEST(CameraFileMount, OfAnotherSizeIsRefusedWithItsPlace) {
  test::TempFolder folder;
  test::write_text(folder / "c.yaml", camera_yaml(some_camera(), "") + "mount: [0, 20]\n");
  try {
    read_camera_mount(folder / "c.yaml");
    ADD_FAILURE() << "two numbers were taken";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("c.yaml: mount: holds 2 numbers, not 3 or 6; give roll,pitch,yaw"));
  }
}

}  // namespace
}  // namespace edgevo
