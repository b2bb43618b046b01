// SPDX-License-Identifier: BSD-3-Clause
// Scenes that come back to where they were, and those that only look as if they did.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "edgevo/core/error.h"
#include "edgevo/simulation/scene_renderer.h"

namespace edgevo {
namespace {

using ::testing::Each;
using ::testing::Ge;
using ::testing::Le;

constexpr double kDegrees = 180 / M_PI;

// Where a frame of a scene was taken.
struct Location {
  Eigen::Vector2d position;
  double yaw_deg;
};

Location location_of(const Scene& scene, int i) {
  const SE3& T = scene.T_scene_cam[size_t(i)];
  const Eigen::Vector3d forward = T.R().col(2);
  return {T.translation().head<2>(), std::atan2(forward.y(), forward.x()) * kDegrees};
}

double between(const Location& a, const Location& b) { return (a.position - b.position).norm(); }
double turn_between(const Location& a, const Location& b) {
  return std::abs(std::remainder(a.yaw_deg - b.yaw_deg, 360));
}

// All turns of a scene up to frame `end`, degrees; to the left positive.
double turned_until(const Scene& scene, int end) {
  double sum = 0;
  for (int i = 1; i < end; ++i)
    sum += std::remainder(location_of(scene, i).yaw_deg - location_of(scene, i - 1).yaw_deg, 360);
  return sum;
}

double length_driven(const Scene& scene) {
  double length = 0;
  for (int i = 1; i < scene.size(); ++i) length += between(location_of(scene, i), location_of(scene, i - 1));
  return length;
}

// For each tenth frame from `begin` on: the nearest one of the frames before `end`.
struct Revisits {
  std::vector<double> distance, turn_deg;
};

Revisits revisits(const Scene& scene, int begin, int end) {
  Revisits found;
  for (int i = begin; i < scene.size(); i += 10) {
    const Location here = location_of(scene, i);
    Location nearest = location_of(scene, 0);
    for (int k = 1; k < end; ++k)
      if (between(location_of(scene, k), here) < between(nearest, here)) nearest = location_of(scene, k);
    found.distance.push_back(between(nearest, here));
    found.turn_deg.push_back(turn_between(nearest, here));
  }
  return found;
}

double middle_of(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + long(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// First frame at or after the time at which the light begins to change.
int frame_of_change(const Scene& scene) {
  return int(scene.light_change->begins_s / seconds_between(scene.times[0], scene.times[1]));
}

TEST(Circuit, IsDrivenRoundTwiceSideBySide) {
  const Scene scene = load_scene("circuit");
  EXPECT_NEAR(length_driven(scene), 1050, 50);
  EXPECT_LE(scene.size(), 2400);
  const int second = frame_of_change(scene) + 30;  // the lane is changed by then
  EXPECT_NEAR(turned_until(scene, second), 360, 5);
  EXPECT_NEAR(turned_until(scene, scene.size()), 720, 5);
  const Revisits laps = revisits(scene, second, second - 20);
  EXPECT_THAT(laps.distance, Each(Le(0.8)));
  EXPECT_NEAR(middle_of(laps.distance), 0.5, 0.1);
  EXPECT_THAT(laps.turn_deg, Each(Le(5)));
}

TEST(Circuit, TheShortOneIsOfItsKind) {
  const Scene scene = load_scene("circuit_short");
  EXPECT_NEAR(length_driven(scene), 550, 30);
  EXPECT_LE(scene.size(), 1200);
  EXPECT_NEAR(turned_until(scene, scene.size()), 720, 5);
  const int second = frame_of_change(scene) + 30;
  const Revisits laps = revisits(scene, second, second - 20);
  EXPECT_THAT(laps.distance, Each(Le(0.8)));
  EXPECT_NEAR(middle_of(laps.distance), 0.5, 0.1);
}

TEST(Circuit, IsDrivenTheOtherWayRound) {
  for (const char* name : {"circuit_reverse", "circuit_short_reverse"}) {
    const Scene scene = load_scene(name);
    const int second = scene.size() * 2 / 3, first = scene.size() * 4 / 10;
    const Revisits laps = revisits(scene, second, first);
    EXPECT_NEAR(middle_of(laps.distance), 3, 0.2) << name;  // the other lane
    EXPECT_NEAR(middle_of(laps.turn_deg), 180, 3) << name;
  }
}

// So that a map of one is a map of the other.
TEST(Circuit, InBothDirectionsTheWorldIsTheSame) {
  const auto on = load_scene("circuit_short").world, back = load_scene("circuit_short_reverse").world;
  ASSERT_EQ(on->surfaces.size(), back->surfaces.size());
  for (size_t i = 0; i < on->surfaces.size(); i += 7) {
    EXPECT_EQ(on->surfaces[i].origin, back->surfaces[i].origin) << i;
    EXPECT_EQ(on->surfaces[i].texture, back->surfaces[i].texture) << i;
  }
}

TEST(Circuit, OtherSeedsHaveOtherHousesAlongTheSameStreets) {
  const Scene a = load_scene("circuit_short", 1), b = load_scene("circuit_short", 2);
  EXPECT_LT(between(location_of(a, 500), location_of(b, 500)), 1e-9);
  EXPECT_NE(a.world->surfaces.size(), b.world->surfaces.size());
}

TEST(LightChange, MovesNoSurfaceAndLeavesTheFirstLapAsItIs) {
  const SceneRenderer changing(load_scene("circuit_short")), steady(load_scene("circuit_short:steady"));
  EXPECT_EQ(steady.scene().name, "circuit_short:steady");
  EXPECT_EQ(changing.render_image(100).pixels, steady.render_image(100).pixels);
  EXPECT_NE(changing.render_image(700).pixels, steady.render_image(700).pixels);
  EXPECT_EQ(changing.render_depth(700), steady.render_depth(700));
}

TEST(LightChange, PassesSmoothlyFromOneToTheOther) {
  const LightChange change{{}, {}, 10, 4};
  EXPECT_EQ(change.share(0), 0);
  EXPECT_EQ(change.share(10), 0);
  EXPECT_DOUBLE_EQ(change.share(12), 0.5);
  EXPECT_EQ(change.share(14), 1);
  EXPECT_EQ(change.share(1000), 1);
}

// True if something opaque is between p and the sun.
bool is_hidden(const World& world, const Eigen::Vector3d& p, const Eigen::Vector3d& sun) {
  for (const Surface& s : world.surfaces) {
    Eigen::Matrix3d sides;
    sides << s.side_u, s.side_v, -sun;
    if (world.textures[size_t(s.texture)].is_cut_out() || std::abs(sides.determinant()) < 1e-9) continue;
    const Eigen::Vector3d at = sides.inverse() * (p - s.origin);  // p + t sun = origin + a u + b v
    const bool is_inside = at.x() >= 0 && at.y() >= 0 && at.x() <= 1 && at.y() <= 1;
    if (is_inside && at.z() > 1e-6 && (!s.is_triangle || at.x() + at.y() <= 1)) return true;
  }
  return false;
}

Eigen::Vector3d towards_sun(double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg / kDegrees, e = elevation_deg / kDegrees;
  return {std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e)};
}

// Along the middle of the first street: the shadows of houses fall where a ray to the sun meets them. Trees,
// which have holes, only add to them.
TEST(LightChange, ShadowsLieWhereNoSunReaches) {
  const Scene scene = load_scene("circuit_short");
  const Eigen::Vector3d sun = towards_sun(-25, 24);  // as in the file
  const GroundShadow& shadow = *scene.light_change->second.shadow;
  int dark = 0, agree = 0, lit = 0;
  for (double x = 1; x < 90; x += 0.37)
    for (const double y : {-4.0, 0.0, 4.0}) {
      const bool hidden = is_hidden(*scene.world, {x, y, 0.01}, sun);
      const float factor = shadow.factor(float(x), float(y));
      if (hidden) ++dark, agree += factor < shadow.shade + 0.2f * (1 - shadow.shade);
      if (factor <= 0.99f) continue;
      ++lit;
      EXPECT_FALSE(hidden) << x << " " << y;
    }
  EXPECT_GE(dark, 100);
  EXPECT_GE(lit, 50);
  EXPECT_GE(agree, 0.97 * dark);  // the others lie at the rim, which is soft
}

TEST(DeskRevisit, LooksRoundAndComesBackAnotherWay) {
  const Scene scene = load_scene("desk_revisit");
  const Location first = location_of(scene, 0), away = location_of(scene, scene.size() / 2),
                 last = location_of(scene, scene.size() - 1);
  EXPECT_LT(turn_between(first, last), 25);
  EXPECT_LT(between(first, last), 0.5);
  EXPECT_GT(turn_between(first, away), 140);
  EXPECT_GT(between(first, away), 0.8);
  EXPECT_NEAR(turned_until(scene, scene.size()), 360, 25);
}

TEST(CorridorRevisit, IsWalkedToTheEndBackAndToTheEndAgain) {
  const Scene scene = load_scene("corridor_revisit");
  const Eigen::Vector2d end = {29, 8};
  std::vector<int> at_end, at_start;
  for (int i = 0; i < scene.size(); ++i) {
    if ((location_of(scene, i).position - end).norm() < 1.6) at_end.push_back(i);
    if (i > 300 && location_of(scene, i).position.x() < 1) at_start.push_back(i);
  }
  ASSERT_FALSE(at_end.empty());
  ASSERT_FALSE(at_start.empty());
  EXPECT_LT(at_end.front(), at_start.front());
  EXPECT_LT((location_of(scene, scene.size() - 1).position - end).norm(), 2);
  const int again = at_start.back() + 60;
  const Revisits walks = revisits(scene, again, at_end.front());
  EXPECT_THAT(walks.distance, Each(Le(0.1)));
  EXPECT_LT(middle_of(walks.turn_deg), 3);
  const int back = (at_end.front() + at_start.front()) / 2;
  Scene return_walk = scene;
  return_walk.T_scene_cam.resize(size_t(back) + 100);
  EXPECT_NEAR(middle_of(revisits(return_walk, back - 100, at_end.front()).turn_deg), 180, 6);
}

// A symmetric pinhole, so that a mirrored image has its pixels at the same places.
Scene seen_symmetrically(const char* name) {
  Scene scene = load_scene(name);
  scene.camera = Camera(Pinhole{200, 200, 199.5, 79.5, 400, 160});
  scene.noise_sigma = 0;
  return scene;
}

// Share of the pixels at which two images differ by more than `levels`; those without a depth do not count.
double share_of_others(const GrayImage& a, const GrayImage& b, const std::vector<float>& depth, int levels,
                       double max_depth = 1e9) {
  int count = 0, others = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i)
    if (depth[i] > 0 && depth[i] < max_depth)
      ++count, others += std::abs(int(a.pixels[i]) - int(b.pixels[i])) > levels;
  return double(others) / count;
}

TEST(IdenticalDoors, AfterEachBayAllLooksAsBefore) {
  const Scene scene = seen_symmetrically("identical_doors");
  const SceneRenderer renderer(scene);
  const SE3 here = scene.T_scene_cam[40];
  for (const int bays : {1, 5, 12}) {
    const SE3 there(here.R(), here.translation() + Eigen::Vector3d(3 * bays, 0, 0));
    const std::vector<float> depth = renderer.render_depth_from(here);
    EXPECT_LT(share_of_others(renderer.render_image_from(here, 0), renderer.render_image_from(there, 0),
                              depth, 1, 60),
              0.001)
        << bays;
  }
  const SE3 between_bays(here.R(), here.translation() + Eigen::Vector3d(1.5, 0, 0));
  EXPECT_GT(share_of_others(renderer.render_image_from(here, 0), renderer.render_image_from(between_bays, 0),
                            renderer.render_depth_from(here), 1),
            0.5);
}

TEST(IdenticalDoors, NoPlaceIsSeenTwice) {
  const Scene scene = load_scene("identical_doors");
  for (int i = 1; i < scene.size(); ++i)
    EXPECT_GT(location_of(scene, i).position.x(), location_of(scene, i - 1).position.x()) << i;
  EXPECT_GT(length_driven(scene), 36);  // a dozen bays
}

// As seen through a mirror half way, x = 120.
SE3 mirrored_pose(const SE3& T) {
  const Eigen::DiagonalMatrix<double, 3> in_space(-1, 1, 1), in_image(-1, 1, 1);
  const Eigen::Matrix3d R = in_space * T.R() * in_image;
  return {R, Eigen::Vector3d(240 - T.translation().x(), T.translation().y(), T.translation().z())};
}

template <class T>
std::vector<T> mirrored_rows(const std::vector<T>& values, int width) {
  std::vector<T> out = values;
  for (size_t row = 0; row < out.size(); row += size_t(width))
    std::reverse(out.begin() + long(row), out.begin() + long(row) + width);
  return out;
}

TEST(MirroredStreet, TheSecondHalfIsTheMirrorImageOfTheFirst) {
  const Scene scene = seen_symmetrically("mirrored_street");
  const SceneRenderer renderer(scene);
  for (const int i : {10, 60, 110}) {
    const SE3& here = scene.T_scene_cam[size_t(i)];
    const SE3 there = mirrored_pose(here);
    ASSERT_NEAR(there.R().determinant(), 1, 1e-9);
    const std::vector<float> depth = renderer.render_depth_from(here),
                             other_depth = mirrored_rows(renderer.render_depth_from(there), 400);
    size_t same = 0;
    for (size_t k = 0; k < depth.size(); ++k) same += std::abs(depth[k] - other_depth[k]) <= 1e-3f * depth[k];
    EXPECT_GT(same, 0.995 * double(depth.size())) << i;
    const GrayImage image = renderer.render_image_from(here, 0);
    GrayImage other = renderer.render_image_from(there, 0);
    other.pixels = mirrored_rows(other.pixels, 400);
    EXPECT_LT(share_of_others(image, other, depth, 12), 0.03) << i;
  }
}

TEST(MirroredStreet, ContinuesWithoutAGapAndIsDrivenOnce) {
  const Scene scene = load_scene("mirrored_street");
  EXPECT_LT(location_of(scene, 0).position.x(), 1);
  EXPECT_GT(location_of(scene, scene.size() - 1).position.x(), 230);
  const SceneRenderer renderer(scene);
  const Pinhole pinhole = renderer.undistorted();
  for (int i = 100; i < 130; i += 3) {  // on the road, from 5 m on, depth has no hole
    const std::vector<float> depth = renderer.render_depth(i);
    for (int v = pinhole.height * 3 / 4; v < pinhole.height; ++v) {
      const float z = depth[size_t(v) * size_t(pinhole.width) + size_t(pinhole.cx)];
      EXPECT_THAT(z, ::testing::AllOf(Ge(1), Le(20))) << i << " " << v;
    }
  }
}

}  // namespace
}  // namespace edgevo
