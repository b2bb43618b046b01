// SPDX-License-Identifier: BSD-3-Clause
// Scenes of which the seed draws everything: a seed gives one scene, other seeds give really other ones, and
// each is what it promises to be.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>

#include "edgevo/core/error.h"
#include "edgevo/simulation/correspondence.h"
#include "edgevo/simulation/scene_renderer.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const char* const kDrawnScenes[] = {"tiled_rooms", "open_land", "parked_cars"};
constexpr uint64_t kSeeds = 4;  // of each scene, since each costs a second

// The scenes, drawn once for all tests.
const Scene& drawn(const std::string& name, uint64_t seed) {
  static std::map<std::pair<std::string, uint64_t>, Scene> known;
  const auto it = known.find({name, seed});
  return it != known.end() ? it->second
                           : known.emplace(std::pair(name, seed), load_scene(name, seed)).first->second;
}

Eigen::Vector3d position(const Scene& scene, int i) { return scene.T_scene_cam[size_t(i)].translation(); }

double path_length(const Scene& scene) {
  double length = 0;
  for (int i = 1; i < scene.size(); ++i) length += (position(scene, i) - position(scene, i - 1)).norm();
  return length;
}

double degrees_between(const Scene& scene, int i, int k) {
  const SE3 &a = scene.T_scene_cam[size_t(i)], &b = scene.T_scene_cam[size_t(k)];
  return a.rotation().angularDistance(b.rotation()) * 180 / M_PI;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
  return values[values.size() / 2];
}

double median_depth(const SceneRenderer& renderer, int index) {
  std::vector<double> seen;
  const std::vector<float> depth = renderer.render_depth(index);
  for (size_t i = 0; i < depth.size() * 55 / 100; ++i)  // above the road
    if (depth[i] > 0) seen.push_back(depth[i]);
  return seen.empty() ? 1e9 : median(seen);
}

struct Depths {
  double least = 1e9, most = 0;
};

// Of what stands between 0.4 and 3 m over the ground in the middle column of the image.
Depths depths_of_middle_column(const SceneRenderer& renderer, int index) {
  Depths depths;
  const Pinhole p = renderer.undistorted();
  const std::vector<float> depth = renderer.render_depth(index);
  for (int v = 0; v < p.height; ++v) {
    const double z = depth[size_t(v) * size_t(p.width) + size_t(p.width / 2)];
    const Eigen::Vector3d seen((p.width / 2 - p.cx) / p.fx * z, (v - p.cy) / p.fy * z, z);
    const double height = (renderer.scene().T_scene_cam[size_t(index)] * seen).z();
    if (z > 0 && height > 0.4 && height < 3)
      depths.least = std::min(depths.least, z), depths.most = std::max(depths.most, z);
  }
  return depths;
}

TEST(DrawnScene, SameSeedSameBytesOtherSeedOtherWorld) {
  for (const char* name : kDrawnScenes) {
    const SceneRenderer first(drawn(name, 1)), second(load_scene(name, 1)), other(drawn(name, 2));
    EXPECT_EQ(first.size(), second.size()) << name;
    EXPECT_EQ(first.render_image(7).pixels, second.render_image(7).pixels) << name;
    EXPECT_EQ(first.T_world_cam(first.size() - 1).translation(),
              second.T_world_cam(first.size() - 1).translation());
    EXPECT_NE(first.render_image(7).pixels, other.render_image(7).pixels) << name;
  }
}

TEST(DrawnScene, TheSeedDrawsCameraPathAndWorld) {
  for (const char* name : kDrawnScenes) {
    std::vector<double> focal, length, surfaces;
    for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const Scene& scene = drawn(name, seed);
      focal.push_back(scene.camera.pinhole().fx), length.push_back(path_length(scene));
      surfaces.push_back(double(scene.world->surfaces.size()));
    }
    for (std::vector<double>* values : {&focal, &length, &surfaces}) {
      std::sort(values->begin(), values->end());
      EXPECT_EQ(std::adjacent_find(values->begin(), values->end()), values->end()) << name;
      EXPECT_GT(values->back(), 1.05 * values->front()) << name;
    }
  }
}

// Where a pixel of one frame lies in the next, by depth and poses: there the images agree.
TEST(DrawnScene, PixelsAgreeWithDepthAndPoses) {
  for (const char* name : kDrawnScenes) {
    Scene scene = drawn(name, 3);
    scene.noise_sigma = 0;
    scene.camera = Camera(scene.camera.pinhole());  // no lens: images have the axes of the depth
    const SceneRenderer renderer(scene);
    const RenderedFrame a = renderer.render(20), b = renderer.render(21);
    const Pinhole p = renderer.undistorted();
    const ViewPair views{p,
                         {a.depth.data(), p.width, p.height, p.width},
                         {b.depth.data(), p.width, p.height, p.width},
                         b.T_world_cam.inverse() * a.T_world_cam};
    double there = 0, unmoved = 0;
    int count = 0;
    for (int v = 4; v < p.height; v += 5)
      for (int u = 4; u < p.width; u += 5) {
        const Correspondence c = find_correspondence(views, {double(u), double(v)});
        const int x = int(std::lround(c.px.x())), y = int(std::lround(c.px.y()));
        if (!c.visible || x < 0 || y < 0 || x >= p.width || y >= p.height) continue;
        const auto gray = [&](const RenderedFrame& f, int gx, int gy) {
          return double(f.image.pixels[size_t(gy) * size_t(p.width) + size_t(gx)]);
        };
        there += std::abs(gray(b, x, y) - gray(a, u, v)), unmoved += std::abs(gray(b, u, v) - gray(a, u, v));
        ++count;
      }
    ASSERT_GT(count, 1000) << name;
    EXPECT_LT(there, 0.7 * unmoved) << name;
    EXPECT_LT(there / count, 5) << name;
  }
}

TEST(DrawnScene, TheWalkThroughRoomsTurnsALot) {
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scene& scene = drawn("tiled_rooms", seed);
    EXPECT_GE(scene.size(), 150);
    EXPECT_LE(scene.size(), 200);
    double sum = 0, most = 0;
    for (int i = 1; i < scene.size(); ++i) {
      sum += degrees_between(scene, i - 1, i);
      most = std::max(most, degrees_between(scene, i - 1, i));
    }
    EXPECT_GT(sum, 180) << seed;
    EXPECT_GT(most, 2) << seed;
    EXPECT_LT(most, 20) << seed;
  }
}

TEST(DrawnScene, TheOpenLandIsDrivenToAndFro) {
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scene& scene = drawn("open_land", seed);
    const int leg = scene.size() / 6;
    ASSERT_EQ(scene.size(), 6 * leg);
    EXPECT_GE(leg, 60);
    EXPECT_LE(leg, 80);
    const double length = (position(scene, leg) - position(scene, 0)).norm();
    EXPECT_GT(length, 30);
    constexpr double kCut = 8;  // metres that a slow reversal leaves undriven at an end of the legs, twice
    for (int k = 1; k <= 5; ++k) {  // its ends, again and again, without turning round
      EXPECT_NEAR((position(scene, k * leg) - position(scene, 0)).norm(), k % 2 ? length : 0, kCut) << k;
      EXPECT_LT(degrees_between(scene, k * leg, (k - 1) * leg), 20) << k;
    }
    for (int i = 1; i < scene.size(); ++i)
      EXPECT_LT((position(scene, i) - position(scene, i - 1)).norm(), 1.3) << "no jump at " << i;
  }
}

TEST(DrawnScene, OnTheOpenLandAllButTheRoadIsFar) {
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const SceneRenderer renderer(drawn("open_land", seed));
    const int leg = renderer.size() / 6;
    EXPECT_GT(median_depth(renderer, leg), 45) << seed;
    EXPECT_LT(median_depth(renderer, 0), median_depth(renderer, leg)) << seed;
  }
}

TEST(DrawnScene, CarsAreNearAndHousesFar) {
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scene& scene = drawn("parked_cars", seed);
    EXPECT_GE(scene.size(), 150);
    EXPECT_LE(scene.size(), 200);
    EXPECT_GT(path_length(scene), 75);
    const Eigen::Vector3d along = (position(scene, scene.size() - 1) - position(scene, 0)).normalized();
    EXPECT_LT(std::abs(along.dot(scene.T_scene_cam[5].rotation() * Eigen::Vector3d::UnitZ())), 0.35)
        << "it looks sideways";
    const SceneRenderer renderer(scene);
    int near = 0, far = 0;
    for (int i = 0; i < scene.size(); i += 12) {
      const Depths depths = depths_of_middle_column(renderer, i);
      near += depths.least<7, far += depths.most> 12;
    }
    EXPECT_GT(near, 2) << seed;
    EXPECT_GT(far, 8) << seed;
  }
}

TEST(DrawnScene, ItsFileNamesNoWaypoints) {
  const test::TempFolder folder;
  const std::string path = folder / "rooms.yaml";
  std::ofstream(path)
      << "frames: 9\ncamera:\n  width: 640\n  height: 480\n  fx: 320\n  fy: 320\n  cx: 320\n  cy: 240\n"
         "world:\n  kind: tiled_rooms\nway_points:\n  - [0, 0]\n  - [1, 0]\n";
  try {
    load_scene(path);
    ADD_FAILURE() << "was accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("rooms.yaml:11"), HasSubstr("drawn from the seed")));
  }
}

}  // namespace
}  // namespace edgevo
