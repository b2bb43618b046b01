// SPDX-License-Identifier: BSD-3-Clause
// Rolling shutter and motion blur: each row from its own pose, the mean along the true motion.
#include <gmock/gmock.h>

#include <cmath>
#include <memory>

#include "edgevo/core/error.h"
#include "edgevo/simulation/scene_renderer.h"
#include "support/white_square.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;

// A scene that ships, without noise, so that rows can be compared.
Scene quiet(const char* name) {
  Scene scene = load_scene(name);
  scene.noise_sigma = 0;
  return scene;
}

// Frame `index` through an instantaneous shutter, from the pose of the scene's camera `seconds` later.
GrayImage instant(Scene scene, int index, double seconds) {
  scene.shutter = {};
  scene.T_scene_cam[size_t(index)] = scene.T_scene_cam_at(scene.times[size_t(index)].seconds() + seconds);
  return SceneRenderer(scene).render_image(index);
}

std::vector<uint8_t> row(const GrayImage& image, int v) {
  const auto begin = image.pixels.begin() + std::ptrdiff_t(v) * image.width;
  return {begin, begin + image.width};
}

class RollingShutter : public ::testing::TestWithParam<const char*> {};

TEST_P(RollingShutter, RowsAreThoseOfACameraAtTheirTime) {
  Scene scene = quiet(GetParam());
  scene.shutter.rolling_s = 0.03;
  const GrayImage rolling = SceneRenderer(scene).render_image(7);
  const GrayImage global = instant(scene, 7, 0);
  EXPECT_NE(row(rolling, 0), row(global, 0));
  for (int v : {0, rolling.height / 3, rolling.height - 1}) {
    const double seconds = 0.03 * (double(v) / (rolling.height - 1) - 0.5);
    EXPECT_EQ(row(rolling, v), row(instant(scene, 7, seconds), v)) << "row " << v;
  }
}

// With and without lens distortion.
INSTANTIATE_TEST_SUITE_P(Scenes, RollingShutter, ::testing::Values("desk", "corridor"));

TEST(Shutter, MotionBetweenFramesPassesThroughTheFrames) {
  for (const char* name : {"desk", "rotation"}) {
    const Scene scene = load_scene(name);
    for (int i : {0, 1, 40, scene.size() - 1}) {
      const SE3 off =
          scene.T_scene_cam[size_t(i)].inverse() * scene.T_scene_cam_at(scene.times[size_t(i)].seconds());
      EXPECT_LT(off.log().norm(), 1e-6) << name << " " << i;  // the times are rounded to 100 ns
    }
    for (double seconds : {-0.02, scene.times.back().seconds() + 0.05})  // and goes on beyond them
      EXPECT_LT((scene.T_scene_cam_at(seconds).inverse() * scene.T_scene_cam_at(seconds + 1e-3)).log().norm(),
                0.1);
  }
}

TEST(Shutter, DepthAndPoseStayThoseOfTheMiddle) {
  Scene scene = quiet("desk");
  const RenderedFrame instant = SceneRenderer(scene).render(5);
  scene.shutter = {0.02, 0.01};
  const RenderedFrame frame = SceneRenderer(scene).render(5);
  EXPECT_EQ(frame.depth, instant.depth);
  EXPECT_EQ(frame.time, instant.time);
  EXPECT_EQ(frame.T_world_cam.matrix(), instant.T_world_cam.matrix());
  EXPECT_NE(frame.image.pixels, instant.image.pixels);
}

TEST(Shutter, SameSeedSameBytes) {
  Scene scene = load_scene("desk");
  scene.shutter = {0.01, 0.005};
  EXPECT_EQ(SceneRenderer(scene).render_image(3).pixels, SceneRenderer(scene).render_image(3).pixels);
}

Camera small_camera() {
  Camera camera;
  camera.set_pinhole({410.3, 405.7, 158.61, 121.37, 320, 240});
  return camera;
}

TEST(ExposureTime, OfACameraAtRestChangesNothing) {
  Scene scene = test::white_square(small_camera());
  scene.noise_sigma = 2;
  const GrayImage sharp = SceneRenderer(scene).render_image(0);
  scene.T_scene_cam_at = [T = scene.T_scene_cam[0]](double) { return T; };
  scene.shutter = {0.03, 0.03};
  EXPECT_EQ(SceneRenderer(scene).render_image(0).pixels, sharp.pixels);
}

// Sum of what is brighter than the dark plain, and its centre.
struct Blob {
  double mass = 0;
  Eigen::Vector2d centre = {0, 0};
};

Blob blob(const GrayImage& image) {
  Blob b;
  for (int v = 0; v < image.height; ++v)
    for (int u = 0; u < image.width; ++u) {
      const double light = image.view().at(u, v) - 20;
      b.mass += light;
      b.centre += light * Eigen::Vector2d(u, v);
    }
  b.centre /= b.mass;
  return b;
}

TEST(ExposureTime, SpreadsAlongTheMotionAboutTheSameCentre) {
  Scene scene = test::white_square(small_camera());
  const GrayImage sharp = SceneRenderer(scene).render_image(0);
  constexpr double kSpeed = 3;  // m/s, to the right: 3 * 0.04 / 4 * 410 = 12.3 px of blur
  const SE3 start = scene.T_scene_cam[0];
  scene.T_scene_cam_at = [=](double t) {
    return start * SE3(Eigen::Quaterniond::Identity(), {kSpeed * t, 0, 0});
  };
  scene.shutter.exposure_s = 0.04;
  const GrayImage blurred = SceneRenderer(scene).render_image(0);
  const Blob before = blob(sharp), after = blob(blurred);
  EXPECT_NEAR(after.mass, before.mass, 0.003 * before.mass);
  EXPECT_NEAR(after.centre.x(), before.centre.x(), 0.05);
  EXPECT_NEAR(after.centre.y(), before.centre.y(), 0.05);
  // The left side moves across 12.3 columns: across them the brightness rises by a constant step.
  const int v = int(before.centre.y());
  int columns = 0;
  for (int u = 0; u < int(before.centre.x()); ++u)
    columns += blurred.view().at(u, v) > 25 && blurred.view().at(u, v) < 195;
  EXPECT_NEAR(columns, 12.3 * 170 / 180, 1.5);
  EXPECT_EQ(blurred.view().at(int(before.centre.x()), v), 200);
}

std::string refusal(const Scene& scene) {
  try {
    SceneRenderer renderer(scene);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(Shutter, TimesThatDoNotFitAreRefused) {
  Scene scene = load_scene("desk");  // 30 images a second
  scene.shutter = {0.04, 0};
  EXPECT_THAT(refusal(scene), HasSubstr("read-out of the rolling shutter"));
  scene.shutter = {0, 0.04};
  EXPECT_THAT(refusal(scene), HasSubstr("exposure"));
  scene.shutter = {0, -0.01};
  EXPECT_THAT(refusal(scene), HasSubstr("exposure"));
  scene.shutter = {0, std::nan("")};
  EXPECT_THAT(refusal(scene), HasSubstr("exposure"));
  scene.shutter = {0, 0.01};
  scene.T_scene_cam_at = {};
  EXPECT_THAT(refusal(scene), HasSubstr("no motion between its frames"));
}

}  // namespace
}  // namespace edgevo
