// SPDX-License-Identifier: BSD-3-Clause
// A calibration file and images that are smaller than those it was made with, or turned.
#include "camera_fit.h"

#include "edgevo/datasets/open_source.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

using test::error_of;
using test::TempFolder;
using test::write_text;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class CameraFit : public ::testing::Test {
 protected:
  Camera fit(const std::string& text, const SeenImages& images, double scale = 0) {
    write_text(folder_ / "camera.txt", text);
    decisions_.clear();
    return camera_of_file({folder_ / "camera.txt", "", scale}, images, &decisions_);
  }
  InputDecision decision() const { return decisions_.size() == 1 ? decisions_[0] : InputDecision(); }
  TempFolder folder_;
  std::vector<InputDecision> decisions_;
};

constexpr const char* kFull = "720 700 610 180 0.1 -0.02 0.003 0.004 1240 376 0.005";

TEST_F(CameraFit, KeepsACalibrationOfTheImagesSizeAndSaysNothing) {
  EXPECT_EQ(fit(kFull, {{}, 1240, 376, 0}).pinhole().cx, 610);
  EXPECT_THAT(decisions_, IsEmpty());
}

TEST_F(CameraFit, TakesAMissingSizeFromTheImages) {
  const Camera camera = fit("500 0 320\n0 500 240\n0 0 1\n", {{}, 640, 480, 0});
  EXPECT_EQ(camera.width, 640);
  EXPECT_EQ(camera.height, 480);
  EXPECT_EQ(to_string(decision()),
            "camera: for 640x480 (the file has no image size; that of the images is taken)");
  EXPECT_EQ(decision().doubt, "");
  fit("495.6 0 269.5\n0 495.5 169.2\n0 0 1\n", {{}, 640, 480, 0});  // of images of 540x360
  EXPECT_THAT(decision().doubt, HasSubstr("may not be that of the calibration"));
  EXPECT_THAT(error_of([&] { fit("500 500 320 240", {}); }), HasSubstr("image size is missing"));
  EXPECT_THAT(error_of([&] {
                fit("500 500 320 240", {{}, 300, 200, 0});
              }),
              HasSubstr("principal point lies"));
}

TEST_F(CameraFit, ScalesACalibrationOfTheSameShape) {
  const Pinhole p = fit(kFull, {{}, 930, 282, 0}).pinhole();  // three quarters
  EXPECT_NEAR(p.fx, 540, 1e-9);
  EXPECT_NEAR(p.fy, 525, 1e-9);
  EXPECT_NEAR(p.cx, 610.5 * 0.75 - 0.5, 1e-9);
  EXPECT_NEAR(p.cy, 180.5 * 0.75 - 0.5, 1e-9);
  EXPECT_EQ(decision().value, "scaled from 1240x376 to 930x282");
  EXPECT_THAT(decision().doubt, HasSubstr("cut out of larger images"));
}

TEST_F(CameraFit, TakesTheScaleThatTheUserGives) {
  const Pinhole p = fit(kFull, {{}, 930, 282, 0}, 0.75).pinhole();
  EXPECT_NEAR(p.fx, 540, 1e-9);
  EXPECT_NEAR(p.cx, 610.5 * 0.75 - 0.5, 1e-9);
  EXPECT_EQ(decision().value, "scaled by 0.7500, as --camera-scale says");
  EXPECT_EQ(decision().doubt, "");
  const Pinhole without_size = fit("500 500 320 240", {{}, 320, 240, 0}, 0.5).pinhole();
  EXPECT_NEAR(without_size.cx, 159.75, 1e-9);
  EXPECT_EQ(without_size.width, 320);
  EXPECT_THAT(error_of([&] {
                fit(kFull, {{}, 930, 282, 0}, 0.5);
              }),
              HasSubstr("at --camera-scale 0.5000 it is for images of 620x188, but these have 930x282"));
}

TEST_F(CameraFit, AScaleWithoutACameraFileIsRefused) {
  test::write_images(folder_ / "image_0", 2);
  write_text(folder_ / "times.txt", "0.0\n0.1\n");
  write_text(folder_ / "calib.txt", "P0: 20 0 12 0 0 20 8 0 0 0 1 0\n");
  SourceOptions options;
  options.path = folder_.path();
  options.camera_scale = 0.5;
  EXPECT_THAT(error_of([&] { open_source(options); }), HasSubstr("--camera-scale: is of no use"));
}

TEST_F(CameraFit, RefusesAnotherShapeAndNamesBothSizes) {
  EXPECT_THAT(
      error_of([&] {
        fit(kFull, {{}, 640, 480, 0});
      }),
      HasSubstr("the image is 640x480, but the camera model is for 1240x376, of another shape; give"));
  EXPECT_THAT(error_of([&] { fit(kFull, {{}, 1241, 377, 0}); }), HasSubstr("of another shape"));  // a crop
  EXPECT_THAT(error_of([&] { fit(kFull, {{}, 376, 1240, 0}); }), HasSubstr("the images are turned; turn"));
}

// A point keeps its ray, turned about the axis, whatever the turn.
TEST_F(CameraFit, TurnsACalibrationWithTheImages) {
  const Camera camera = fit(kFull, {{}, 1240, 376, 0});
  for (int turns = 1; turns < 4; ++turns) {
    const bool upright = turns % 2;
    const Camera turned = fit(kFull, {{}, upright ? 376 : 1240, upright ? 1240 : 376, turns});
    EXPECT_EQ(turned.width, upright ? 376 : 1240);
    for (const Eigen::Vector3d& ray : {Eigen::Vector3d(0.3, 0.1, 1), Eigen::Vector3d(-0.5, 0.2, 1)}) {
      Eigen::Vector3d r = ray;
      Eigen::Vector2d px = *camera.project(ray);
      double height = camera.height, width = camera.width;
      for (int i = 0; i < turns; ++i) {  // a pixel (u, v) moves to (height - 1 - v, u)
        r = {-r.y(), r.x(), r.z()};
        px = {height - 1 - px.y(), px.x()};
        std::swap(height, width);
      }
      EXPECT_LT((*turned.project(r) - px).norm(), 1e-9) << turns;
    }
    EXPECT_THAT(decision().value, HasSubstr("turned by " + std::to_string(90 * turns) + " degrees"));
    EXPECT_EQ(decision().doubt.empty(), upright);  // at 180 degrees the size is the same
  }
}

TEST_F(CameraFit, KeepsACalibrationOfTurnedImages) {
  EXPECT_EQ(fit("700 720 180 610 0 0 0 0 376 1240", {{}, 376, 1240, 1}).pinhole().fx, 700);
  EXPECT_THAT(decisions_, IsEmpty());
}

// One image of another size, even the first, does not decide.
TEST_F(CameraFit, FollowsMostOfTheImages) {
  test::write_images(folder_ / "images", 5);
  write_png(folder_ / "images/000000.png", test::make_image(0, 12, 8));
  write_text(folder_ / "camera.txt", test::kCameraLine);
  SourceOptions options;
  options.path = folder_ / "images";
  options.camera_file = folder_ / "camera.txt";
  const auto source = open_source(options);
  EXPECT_EQ(source->camera().width, 24);
  for (const InputDecision& d : source->decisions()) EXPECT_NE(d.subject, "camera");
  EXPECT_THROW(source->next(), BadFrame);
  EXPECT_EQ(source->next()->index, 1);
}

}  // namespace
}  // namespace edgevo
