// SPDX-License-Identifier: BSD-3-Clause
// Images through wide lenses show what pinholes that look in the same directions show.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "edgevo/core/rectification.h"
#include "edgevo/simulation/scene_renderer.h"
#include "support/camera_examples.h"

namespace edgevo {
namespace {

constexpr double kDegree = M_PI / 180;

Scene corridor_through(const Camera& camera) {
  static const Scene corridor = load_scene("corridor", 3);
  Scene scene = corridor;
  scene.camera = camera;
  scene.noise_sigma = 0;
  return scene;
}

// The same lens with a third of the pixels, to save time.
Camera smaller(Camera camera) {
  const Pinhole p = camera.pinhole();
  camera.set_pinhole({p.fx / 3, p.fy / 3, p.cx / 3, p.cy / 3, p.width / 3, p.height / 3});
  return camera;
}

// Mean of the 3x3 pixels around (u, v).
double mean_around(const GrayImage& image, int u, int v) {
  double sum = 0;
  for (int y = v - 1; y <= v + 1; ++y)
    for (int x = u - 1; x <= u + 1; ++x) sum += image.view().at(x, y);
  return sum / 9;
}

double median_of(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// A pinhole whose axis is the ray, with pixels of the same angle as the fisheye's.
GrayImage looking_along(const Scene& scene, const SE3& T_scene_cam, const Eigen::Vector3d& ray, double f) {
  Scene narrow = scene;
  narrow.camera = Camera(Pinhole{f, f, 8, 8, 17, 17});
  const Eigen::Quaterniond R = Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), ray);
  return SceneRenderer(narrow).render_image_from(T_scene_cam * SE3(R, Eigen::Vector3d::Zero()), 0);
}

TEST(LensRendering, AFisheyeOf230DegreesShowsEachDirectionRightAlsoSidewaysAndBack) {
  Camera fisheye;
  const double f = 80;
  fisheye.model = KannalaBrandtModel{};
  fisheye.set_pinhole({f, f, 159.5, 159.5, 320, 320});
  const Scene scene = corridor_through(fisheye);
  const SceneRenderer renderer(scene);
  const SE3 T_scene_cam = scene.T_scene_cam[200];
  const GrayImage image = renderer.render_image_from(T_scene_cam, 0);
  for (const double angle : {3.0, 40.0, 46.0, 70.0, 89.0, 93.0, 110.0}) {
    std::vector<double> differences;
    for (double azimuth = 5; azimuth < 360; azimuth += 20) {
      const Eigen::Vector3d ray(std::sin(angle * kDegree) * std::cos(azimuth * kDegree),
                                std::sin(angle * kDegree) * std::sin(azimuth * kDegree),
                                std::cos(angle * kDegree));
      const Eigen::Vector2d px = fisheye.project(ray).value();
      const int u = int(std::lround(px.x())), v = int(std::lround(px.y()));
      const GrayImage seen = looking_along(scene, T_scene_cam, *fisheye.unproject({double(u), double(v)}), f);
      differences.push_back(std::abs(mean_around(image, u, v) - mean_around(seen, 8, 8)));
    }
    EXPECT_LT(median_of(differences), 2.0) << angle << " degrees from the axis";
  }
}

TEST(LensRendering, RectifiedTheImageOfEachLensIsThatOfThePinhole) {
  for (const test::CameraExample& example : test::camera_examples()) {
    if (example.camera.plumb_bob()) continue;
    const Camera camera = smaller(example.camera);
    const Scene scene = corridor_through(camera);
    const Rectification rectification(camera);
    const RectificationMaps maps = rectification.maps();
    const SceneRenderer lens(scene);
    const SceneRenderer pinhole(corridor_through(Camera(lens.undistorted())));
    EXPECT_TRUE(lens.undistorted() == rectification.target());
    const GrayImage raw = lens.render_image(100), expected = pinhole.render_image(100);
    std::vector<double> differences;
    for (int v = 5; v < maps.height - 5; v += 3)
      for (int u = 5; u < maps.width - 5; u += 3) {
        const size_t i = size_t(v) * size_t(maps.width) + size_t(u);
        const int x = int(std::lround(maps.x[i])), y = int(std::lround(maps.y[i]));
        if (x < 1 || y < 1 || x >= raw.width - 1 || y >= raw.height - 1) continue;
        if (!maps.missing.empty() && maps.missing[i]) continue;
        differences.push_back(std::abs(mean_around(raw, x, y) - mean_around(expected, u, v)));
      }
    ASSERT_GT(differences.size(), 1000u) << example.name;
    EXPECT_LT(median_of(differences), 2.0) << example.name;
  }
}

TEST(LensRendering, DepthIsThatOfTheRectifiedImage) {
  const Scene scene = corridor_through(test::wide_camera(KannalaBrandtModel{}, 190));
  const SceneRenderer lens(scene), pinhole(corridor_through(Camera(lens.undistorted())));
  EXPECT_EQ(lens.render_depth(50), pinhole.render_depth(50));
}

TEST(LensRendering, BeyondTheLensTheImageIsBlack) {
  Camera fisheye;
  fisheye.model = ExtendedUnifiedModel{{}, 0.7, 1};  // ends within the image
  fisheye.set_pinhole({120, 120, 319.5, 239.5, 640, 480});
  ASSERT_FALSE(fisheye.unproject({0, 0}));
  EXPECT_EQ(SceneRenderer(corridor_through(fisheye)).render_image(0).pixels.front(), 0);
}

}  // namespace
}  // namespace edgevo
