// SPDX-License-Identifier: BSD-3-Clause
// Bodies that move through rendered scenes: the mask covers exactly what they change, nearer things hide
// them.
#include "edgevo/simulation/traffic.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "edgevo/core/error.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {
namespace {

// A street seen by a small camera without noise.
Scene small_street() {
  Scene scene = load_scene("street");
  scene.camera.set_pinhole({180, 180, 155, 46, 310, 94});
  scene.noise_sigma = 0;
  return scene;
}

Scene street_with(const std::string& kind) {
  Scene scene = small_street();
  add_traffic(kind, &scene);
  return scene;
}

double share_of_bodies(const SceneRenderer& renderer, int frame) {
  const GrayImage bodies = renderer.render_bodies(frame);
  const auto scene = std::count(bodies.pixels.begin(), bodies.pixels.end(), uint8_t(255));
  return 1 - double(scene) / double(bodies.pixels.size());
}

class StreetTraffic : public ::testing::TestWithParam<std::string> {};

TEST_P(StreetTraffic, ChangesTheImageWhereItsMaskIsAndNowhereElse) {
  Scene with = street_with(GetParam());
  Scene without = with;
  without.bodies.clear();
  const SceneRenderer all(std::move(with)), empty(std::move(without));
  int seen = 0;
  for (int frame = 60; frame <= 140; frame += 20) {
    const GrayImage bodies = all.render_bodies(frame), image = all.render_image(frame),
                    bare = empty.render_image(frame);
    int same_on_bodies = 0, on_bodies = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
      const bool is_same = image.pixels[i] == bare.pixels[i], is_body = bodies.pixels[i] != 255;
      ASSERT_TRUE(is_same || is_body) << "frame " << frame;
      on_bodies += is_body;
      same_on_bodies += is_body && is_same;
    }
    EXPECT_LE(same_on_bodies, 0.2 * on_bodies + 10) << "frame " << frame;
    seen += on_bodies;
  }
  EXPECT_GT(seen, 50);
}

TEST_P(StreetTraffic, IsTheSameForEqualSeeds) {
  const SceneRenderer a(street_with(GetParam())), b(street_with(GetParam()));
  EXPECT_EQ(a.render_image(80).pixels, b.render_image(80).pixels);
}

INSTANTIATE_TEST_SUITE_P(Traffic, StreetTraffic,
                         ::testing::Values("lorry", "overtaking", "oncoming", "crossing", "bus",
                                           "stop-and-go"));

TEST(Traffic, ALorryIsCaughtUpWithAndPullsAway) {
  const SceneRenderer renderer(street_with("lorry"));
  EXPECT_LT(share_of_bodies(renderer, 30), share_of_bodies(renderer, 60));
  EXPECT_LT(share_of_bodies(renderer, 60), share_of_bodies(renderer, 90));
  EXPECT_GT(share_of_bodies(renderer, 90), 0.1);
  EXPECT_LT(share_of_bodies(renderer, 220), 0.05);
}

TEST(Traffic, ABodyHasTheDepthOfItsNearestSurface) {
  const SceneRenderer renderer(street_with("lorry"));
  const std::vector<float> with = renderer.render_depth(80),
                           world = renderer.render_depth_from(renderer.scene().T_scene_cam[80]);
  int nearer = 0;
  for (size_t i = 0; i < with.size(); ++i) {
    if (with[i] == world[i]) continue;
    EXPECT_TRUE(world[i] == 0 || with[i] < world[i]);
    ++nearer;
  }
  EXPECT_NEAR(double(nearer) / double(with.size()), share_of_bodies(renderer, 80), 0.02);
}

TEST(Traffic, TheCameraStandsWhileABusCrosses) {
  const Scene scene = street_with("bus");
  EXPECT_GT(scene.size(), small_street().size() + 70);
  int standing = 0;
  for (int i = 1; i < scene.size(); ++i)
    standing +=
        (scene.T_scene_cam[size_t(i)].translation() - scene.T_scene_cam[size_t(i) - 1].translation()).norm() <
        1e-6;
  EXPECT_NEAR(standing, 80, 3);
}

TEST(Traffic, StopAndGoKeepsTheWholeDrive) {
  const Scene scene = street_with("stop-and-go"), drive = small_street();
  EXPECT_LT((scene.T_scene_cam.back().translation() - drive.T_scene_cam.back().translation()).norm(), 1.0);
}

TEST(Traffic, PeopleWalkInACorridor) {
  Scene scene = load_scene("corridor");
  add_traffic("people", &scene);
  const SceneRenderer renderer(std::move(scene));
  EXPECT_GT(share_of_bodies(renderer, 70), 0.01);
}

TEST(Traffic, RefusesWhatItCannotDo) {
  Scene desk = load_scene("desk");
  EXPECT_THROW(add_traffic("oncoming", &desk), InputError) << "no road";
  Scene street = small_street();
  EXPECT_THROW(add_traffic("lorries", &street), InputError);
}

}  // namespace
}  // namespace edgevo
