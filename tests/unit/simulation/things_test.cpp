// SPDX-License-Identifier: BSD-3-Clause
// What each pixel of a rendered frame is part of.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {
namespace {

std::set<Thing> things_in(const std::string& scene, int frame) {
  const SceneRenderer renderer(load_scene(scene, 7));
  std::set<Thing> things;
  for (const uint8_t t : renderer.render_things(frame).pixels)
    if (t != kNoThing) things.insert(Thing(t));
  return things;
}

TEST(Things, AStreetHasAllThatADriverNames) {
  const std::set<Thing> things = things_in("street", 0);
  for (const Thing t : {Thing::kMarking, Thing::kKerb, Thing::kPole, Thing::kPlant, Thing::kObject,
                        Thing::kBuilding, Thing::kGround})
    EXPECT_TRUE(things.count(t)) << to_string(t);
}

TEST(Things, AMotorwayHasBarriersAndACorridorHandrails) {
  EXPECT_TRUE(things_in("motorway", 0).count(Thing::kRail));
  EXPECT_TRUE(things_in("corridor", 0).count(Thing::kRail));
  EXPECT_FALSE(things_in("corridor", 0).count(Thing::kKerb));
}

TEST(Things, TheSkyIsNone) {
  const SceneRenderer renderer(load_scene("motorway", 7));
  const std::vector<float> depth = renderer.render_depth(3);
  const GrayImage things = renderer.render_things(3);
  ASSERT_EQ(things.pixels.size(), depth.size());
  for (size_t i = 0; i < depth.size(); ++i) ASSERT_EQ(things.pixels[i] == kNoThing, depth[i] == 0) << i;
}

TEST(Things, MarkingsAndKerbsAreLow) {
  const SceneRenderer renderer(load_scene("street", 7));
  const Pinhole p = renderer.undistorted();
  const std::vector<float> depth = renderer.render_depth(0);
  const GrayImage things = renderer.render_things(0);
  for (size_t i = 0; i < depth.size(); ++i) {
    const Thing thing = Thing(things.pixels[i]);
    if (thing != Thing::kMarking && thing != Thing::kKerb) continue;
    const Eigen::Vector2d px(double(i % size_t(p.width)), double(i / size_t(p.width)));
    const Eigen::Vector3d at = renderer.scene().T_scene_cam[0] * (double(depth[i]) * p.ray(px));
    ASSERT_LT(at.z(), 0.2) << to_string(thing);
  }
}

}  // namespace
}  // namespace edgevo
