// SPDX-License-Identifier: BSD-3-Clause
// Scene files: shipped scenes are valid, the same seed gives the same bytes, and bad files give one clear
// line.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <opencv2/imgproc.hpp>
#include <sstream>

#include "edgevo/core/error.h"
#include "edgevo/core/records.h"
#include "edgevo/simulation/rendered_source.h"
#include "edgevo/simulation/scene_renderer.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

// The text of a scene that ships, with one thing replaced.
std::string edited(const std::string& scene, const std::string& what, const std::string& by) {
  std::ifstream in(std::string(EDGEVO_SOURCE_DIR) + "/datasets/scenes/" + scene + ".yaml");
  std::stringstream text;
  text << in.rdbuf();
  std::string s = text.str();
  const size_t at = s.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return s.replace(at, what.size(), by);
}

// Message of load_scene for that text; empty if it is accepted.
std::string refusal(const std::string& text) {
  const test::TempFolder folder;
  const std::string path = folder / "bad_scene.yaml";
  std::ofstream(path) << text;
  try {
    load_scene(path);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(BadScene, UnknownKeyOffersTheNearest) {
  EXPECT_THAT(refusal(edited("desk", "rate_hz:", "rate_hertz:")),
              AllOf(HasSubstr("rate_hertz"), HasSubstr("rate_hz")));
  EXPECT_THAT(refusal(edited("desk", "amplitude:", "amplitud:")), HasSubstr("motion.amplitude"));
}

TEST(BadScene, MissingTextureKind) {
  EXPECT_THAT(refusal(edited("desk", "walls: plaster", "walls: plastre")),
              AllOf(HasSubstr("plastre"), HasSubstr("'plaster'")));
}

TEST(BadScene, NoFrames) {
  EXPECT_THAT(refusal(edited("desk", "frames: 450", "frames: 0")), HasSubstr("frames"));
  EXPECT_THAT(refusal(edited("desk", "frames: 450", "")), HasSubstr("frames is missing"));
}

TEST(BadScene, PathThroughAWall) {
  EXPECT_THAT(refusal(edited("street", "lane_offset: 1.5", "lane_offset: 11")),
              AllOf(HasSubstr("through a wall between frames"), Not(HasSubstr("\n"))));
}

TEST(BadScene, PathTooShort) {
  EXPECT_THAT(refusal(edited("street", "frames: 360", "frames: 36000")), HasSubstr("the path ends at frame"));
  EXPECT_THAT(refusal(edited("street", "turn_radius: 8", "turn_radius: 300")),
              HasSubstr("too short for its turn"));
}

TEST(BadScene, Waypoints) {
  EXPECT_THAT(refusal(edited("desk", "  - [1.05, 0, 0.74]", "")), HasSubstr("fewer than two waypoints"));
  EXPECT_THAT(refusal(edited("desk", "  - [1.05, 0, 0.74]", "  - [1.05]")),
              HasSubstr("list of two or three numbers"));
  EXPECT_THAT(refusal(edited("desk", "  - [1.05, 0, 0.74]", "  - [a, b]")),
              HasSubstr("34: is not a waypoint"));
  EXPECT_THAT(refusal(edited("desk", "way_points:", "other_points:")), HasSubstr("list"));
  EXPECT_THAT(refusal(edited("desk", "  - [1.05, 0, 0.74]", "  - [1.05, 0, 0.74]\n  - [0, 0, 1]")),
              HasSubstr("pairs of waypoints"));
  EXPECT_THAT(refusal(edited("desk", "  - [1.05, 0, 0.74]", "  - [1, 2, 3, 4]")),
              HasSubstr("list of two or three numbers"));
  EXPECT_THAT(refusal(edited("desk", "  - [1.05, 0, 0.74]", "  - [nan, 2]")), HasSubstr("beyond 100 km"));
  EXPECT_THAT(refusal(edited("desk", "  - [1.05, 0, 0.74]", "  - 1.05")),
              HasSubstr("list of two or three numbers"));
  EXPECT_THAT(refusal(edited("desk", "way_points:  ", "way_points: []")),
              HasSubstr("something follows way_points"));
  EXPECT_THAT(refusal(edited("desk", "seed: 1", "way_points:\n  - [0, 0]")), HasSubstr("given already"));
}

// "bad_scene.yaml:LINE: ", the line of that text in a shipped scene.
std::string at_line_of(const std::string& scene, const std::string& what) {
  std::ifstream in(std::string(EDGEVO_SOURCE_DIR) + "/datasets/scenes/" + scene + ".yaml");
  std::string line;
  int number = 1;
  while (std::getline(in, line) && line.find(what) == std::string::npos) ++number;
  return "bad_scene.yaml:" + std::to_string(number) + ": ";
}

// Waypoints first, then the rest: the lines below keep their numbers.
TEST(BadScene, MessagesNameTheLine) {
  const auto with_points_first = [](const char* points, const char* rest) {
    return refusal(std::string("way_points:  # metres\n") + points + rest);
  };
  const char* const points = "  - [0, 0, 1.35]\n\n  - [1, 0, 0.74]  # the desk\n";
  EXPECT_THAT(with_points_first(points, "frames: 9\nrate_herz: 3\n"),
              HasSubstr("bad_scene.yaml:6: unknown parameter"));
  EXPECT_THAT(with_points_first(points, "frames: 0\n"), HasSubstr("bad_scene.yaml:5: frames"));
  EXPECT_THAT(with_points_first("  - [0, 0]\n  - [0, zero]\n", "frames: 9\n"),
              HasSubstr("bad_scene.yaml:3: is not a waypoint"));
  EXPECT_THAT(with_points_first("  - [0, 0]\n", "frames: 9\n"),
              HasSubstr("bad_scene.yaml:1: has fewer than two"));
  EXPECT_THAT(refusal(edited("desk", "walls: plaster", "walls: plastre")),
              HasSubstr(at_line_of("desk", "walls:") + "there is no texture"));
  EXPECT_THAT(refusal(edited("street", "sky: clouds", "sky: cloud")),
              HasSubstr(at_line_of("street", "sky:") + "there is no texture"));
  EXPECT_THAT(refusal(edited("street", "lane_offset: 1.5", "lane_offset: 11")),
              HasSubstr(at_line_of("street", "way_points:") + "the camera passes"));
  EXPECT_THAT(refusal(edited("street", "frames: 360", "frames: 36000")),
              HasSubstr(at_line_of("street", "way_points:") + "the path ends"));
}

TEST(BadScene, Streets) {
  EXPECT_THAT(refusal(edited("circuit_short", "- [0, 0, 90, 0]", "- [0, 0, 90]")),
              HasSubstr("is not a street: a list of four numbers"));
  EXPECT_THAT(refusal(edited("circuit_short", "- [0, 0, 90, 0]", "- [0, 0, 0, 1e9]")),
              HasSubstr("a street is beyond 100 km"));
  EXPECT_THAT(refusal(edited("circuit_short", "- [0, 0, 90, 0]", "- [5, 5, 5, 5]")),
              HasSubstr("a street is shorter than 0.1 m"));
}

TEST(BadScene, SecondLap) {
  EXPECT_THAT(refusal(edited("circuit_short", "second_lap: 5", "second_lap: 4")),
              HasSubstr("does not begin on a straight"));
  EXPECT_THAT(refusal(edited("circuit_short", "second_lap: 5", "second_lap: 50")),
              HasSubstr("no leg follows waypoint 50"));
}

TEST(BadScene, TurnsWhereThereMustBeNone) {
  for (const char* name : {"mirrored_street", "identical_doors"})
    EXPECT_THAT(refusal(edited(name, "  - [0, 0]\n", "  - [0, 0]\n  - [20, 1]\n")), HasSubstr("no turns"));
}

TEST(BadScene, NoCamera) {
  EXPECT_THAT(refusal(edited("desk", "  width: 640", "")), HasSubstr("image size"));
}

TEST(BadScene, UnknownNameListsWhatThereIs) {
  try {
    load_scene("no_such_scene");
    ADD_FAILURE() << "was accepted";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("no_such_scene"), HasSubstr("desk"), HasSubstr("street")));
  }
}

TEST(Scene, NamesHoldWhatShips) {
  for (const char* name : {"street",          "desk",
                           "lakeshore",       "corridor",
                           "rotation",        "desk_above",
                           "office_walk",     "tiles",
                           "motorway",        "tiled_rooms",
                           "open_land",       "parked_cars",
                           "circuit",         "circuit_reverse",
                           "circuit_short",   "circuit_short_reverse",
                           "desk_revisit",    "corridor_revisit",
                           "identical_doors", "mirrored_street"})
    EXPECT_THAT(scene_names(), Contains(name));
}

TEST(Scene, ThoseThatTryTheUnitLeadThroughNoWall) {
  for (const char* name : {"desk_above", "office_walk", "tiles", "motorway"})
    EXPECT_NO_THROW(load_scene(name)) << name;
}

// Seeds 3 and 9 first draw a way through the table.
TEST(Scene, AHandIsDrawnAgainUntilItsWayIsFree) {
  for (const uint64_t seed : {3, 9}) {
    Scene scene;
    ASSERT_NO_THROW(scene = load_scene("office_walk", seed)) << seed;
    EXPECT_FALSE(wall_crossed(scene)) << seed;
    EXPECT_EQ(scene.T_scene_cam.size(), scene.times.size());
    EXPECT_EQ(scene.size(), 300);
  }
}

// Two floors at one height take turns in being seen, from image to image.
TEST(Scene, FloorsOfCorridorsThatMeetLieOneAboveTheOther) {
  for (const char* name : {"corridor", "tiles"}) {
    std::vector<const Surface*> floors;
    const Scene scene = load_scene(name);
    for (const Surface& s : scene.world->surfaces)
      if (s.origin.z() < 0.01 && s.side_u.z() == 0 && s.side_v.z() == 0 && s.is_tiled) floors.push_back(&s);
    ASSERT_GE(floors.size(), 5u) << name;
    const auto overlap = [](const Surface& a, const Surface& b, int axis) {
      const auto ends = [axis](const Surface& s) {
        const double from = s.origin[axis], to = from + s.side_u[axis] + s.side_v[axis];
        return std::make_pair(std::min(from, to), std::max(from, to));
      };
      return std::min(ends(a).second, ends(b).second) - std::max(ends(a).first, ends(b).first);
    };
    for (size_t i = 0; i < floors.size(); ++i)
      for (size_t k = 0; k < i; ++k)
        if (overlap(*floors[i], *floors[k], 0) > 0.01 && overlap(*floors[i], *floors[k], 1) > 0.01) {
          EXPECT_GT(std::abs(floors[i]->origin.z() - floors[k]->origin.z()), 5e-4) << name;
        }
  }
}

TEST(Scene, SameSeedSameBytesOtherSeedOtherWorld) {
  const SceneRenderer first(load_scene("desk", 7)), second(load_scene("desk", 7)),
      other(load_scene("desk", 8));
  const RenderedFrame a = first.render(3), b = second.render(3), c = other.render(3);
  EXPECT_EQ(a.image.pixels, b.image.pixels);
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_NE(a.image.pixels, c.image.pixels);
  EXPECT_NE(a.depth, c.depth);
}

TEST(Scene, NoiseHasItsStrengthAndDiffersBetweenFrames) {
  Scene scene = load_scene("desk");
  scene.noise_sigma = 3;
  scene.T_scene_cam[1] = scene.T_scene_cam[0];
  const SceneRenderer renderer(scene);
  const GrayImage a = renderer.render_image(0), b = renderer.render_image(1);
  double sum2 = 0;
  int count = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    if (a.pixels[i] < 20 || a.pixels[i] > 235) continue;  // clamped
    const double d = double(a.pixels[i]) - double(b.pixels[i]);
    sum2 += d * d, ++count;
  }
  EXPECT_NEAR(std::sqrt(sum2 / count), 3 * std::sqrt(2.0), 0.15);  // 0.1 is rounding's share
}

int canny_pixels(const GrayImage& image) {
  cv::Mat gray(image.height, image.width, CV_8U, const_cast<uint8_t*>(image.pixels.data())), blurred, edges;
  cv::GaussianBlur(gray, blurred, {0, 0}, 1);
  cv::Canny(blurred, edges, 40, 80);
  return cv::countNonZero(edges);
}

std::string scene_error(const std::string& name) {
  try {
    load_scene(name);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

double mean_gray(const GrayImage& image) {
  double sum = 0;
  for (const uint8_t gray : image.pixels) sum += gray;
  return sum / double(image.pixels.size());
}

// A season changes leaves and light, but neither the path nor the ground: bare trees let the bright sky
// through.
TEST(SceneSeason, ChangesTheAppearanceAndNotThePath) {
  const SceneRenderer none(load_scene("lakeshore")), summer(load_scene("lakeshore:summer")),
      winter(load_scene("lakeshore:winter"));
  EXPECT_EQ(winter.scene().name, "lakeshore:winter");
  for (const int i : {0, 399})
    EXPECT_EQ((none.scene().T_scene_cam[size_t(i)].matrix() - winter.scene().T_scene_cam[size_t(i)].matrix())
                  .norm(),
              0)
        << i;
  const GrayImage in_summer = summer.render_image(100), in_winter = winter.render_image(100);
  const auto sky = [](const SceneRenderer& renderer) {
    const std::vector<float> depth = renderer.render_depth(100);
    return std::count(depth.begin(), depth.end(), 0.0f);
  };
  EXPECT_GT(sky(winter), sky(summer));
  EXPECT_GT(std::abs(mean_gray(in_summer) - mean_gray(in_winter)), 2);
  for (const char* season : {"spring", "summer", "autumn", "winter"}) {
    const SceneRenderer renderer(load_scene(std::string("lakeshore:") + season));
    const int edges = canny_pixels(renderer.render_image(100));
    EXPECT_GE(edges, 6000) << season;
    EXPECT_LE(edges, 40000) << season;
  }
}

TEST(SceneSeason, UnknownOnesAndWorldsWithoutThem) {
  EXPECT_THAT(scene_error("lakeshore:wintr"),
              AllOf(HasSubstr("'wintr' is not a season"), HasSubstr("'winter'")));
  EXPECT_THAT(scene_error("desk:winter"), HasSubstr("has no seasons"));
  EXPECT_THAT(scene_error("desk:steady"), HasSubstr("has one light anyway"));
  EXPECT_THAT(scene_error("lake:winter"), HasSubstr("neither a file nor a known scene"));
}

// The frames with the fewest and the most, and some between.
TEST(Scene, StreetIsAsRichInEdgesAsARealOne) {
  const SceneRenderer renderer(load_scene("street"));
  for (int i : {20, 126, 240, 339}) {
    const int edges = canny_pixels(renderer.render_image(i));
    EXPECT_GE(edges, 10000) << i;
    EXPECT_LE(edges, 40000) << i;
  }
}

TEST(Scene, StreetIsADriveWithTurns) {
  const Scene scene = load_scene("street");
  ASSERT_GE(scene.size(), 300);
  double length = 0, turned = 0;
  for (int i = 1; i < scene.size(); ++i) {
    const SE3 step = scene.T_scene_cam[size_t(i) - 1].inverse() * scene.T_scene_cam[size_t(i)];
    EXPECT_LT(step.translation().norm(), 1.05) << i;
    EXPECT_LT(step.angle(), 0.1) << i;
    EXPECT_GT(step.translation().z(), 0.2) << i;
    length += step.translation().norm();
    turned += step.angle();
    EXPECT_NEAR(scene.T_scene_cam[size_t(i)].translation().z(), 1.65, 0.06);
  }
  EXPECT_GT(length, 250);
  EXPECT_GT(turned, 3.1);
}

TEST(RenderedSource, DeliversTheRangeInOrder) {
  RenderedSource source(std::make_shared<SceneRenderer>(load_scene("desk")), 5, 8);
  EXPECT_EQ(source.size(), 3);
  EXPECT_EQ(source.next()->index, 5);
  EXPECT_TRUE(source.skip());
  const auto frame = source.next();
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->index, 7);
  EXPECT_NEAR(frame->time.seconds(), 7 / 30.0, 1e-6);
  EXPECT_EQ(frame->image.pixels, source.renderer().render_image(7).pixels);
  EXPECT_FALSE(source.next());
  EXPECT_FALSE(source.skip());
}

TEST(RenderedSource, EmptyRangeIsRefused) {
  const auto renderer = std::make_shared<SceneRenderer>(load_scene("desk"));
  EXPECT_THROW(RenderedSource(renderer, 5, 5), InputError);
  EXPECT_THROW(RenderedSource(renderer, 0, 100000), InputError);
}

// The camera turns on the vehicle that its own camera would be; the way stays.
TEST(MountedScene, LooksWhereTheMountSays) {
  Scene level = load_scene("rotation"), mounted = level;
  mount_camera(parse_camera_mount("0,20,0,0,0,0.1", ""), &mounted);
  for (int i = 0; i < level.size(); i += 40) {
    const SE3 T_vehicle_cam =
        T_zup_world() * level.T_scene_cam[size_t(i)].inverse() * mounted.T_scene_cam[size_t(i)];
    const Eigen::Vector3d axis = T_vehicle_cam.R().col(2);
    EXPECT_NEAR(axis.z(), -std::sin(20 * 3.14159265358979 / 180), 1e-9);
    EXPECT_NEAR(axis.y(), 0, 1e-9);
    EXPECT_LT((T_vehicle_cam.translation() - Eigen::Vector3d(0, 0, 0.1)).norm(), 1e-9);
  }
  const double t = seconds_between(mounted.times[0], mounted.times[5]);
  EXPECT_LT((mounted.T_scene_cam_at(t).inverse() * mounted.T_scene_cam[5]).log().norm(), 1e-9);
}

}  // namespace
}  // namespace edgevo
