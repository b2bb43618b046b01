// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Contents of a scene file. Each struct names its keys once, in visit(); see datasets/scenes/*.yaml.
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/params.h"

namespace edgevo {

struct CameraParams {
  Camera camera;
  void visit(KeyVisitor& v) {
    Pinhole p = camera.pinhole();
    Distortion d = camera.distortion();
    v.integer("width", p.width, 16, 8192, "pixels");
    v.integer("height", p.height, 16, 8192, "pixels");
    v.number("fx", p.fx, 1, 1e5, "focal length, pixels");
    v.number("fy", p.fy, 1, 1e5, "focal length, pixels");
    v.number("cx", p.cx, 0, 8192, "principal point, pixels; (0,0) is the centre of the first pixel");
    v.number("cy", p.cy, 0, 8192, "principal point, pixels");
    v.number("k1", d.k1, -2, 2, "plumb-bob distortion");
    v.number("k2", d.k2, -5, 5, "plumb-bob distortion");
    v.number("p1", d.p1, -0.1, 0.1, "plumb-bob distortion, tangential");
    v.number("p2", d.p2, -0.1, 0.1, "plumb-bob distortion, tangential");
    v.number("k3", d.k3, -5, 5, "plumb-bob distortion");
    camera = Camera(p, d);
    v.number("noise_sigma", noise_sigma, 0, 50, "noise of the sensor, gray levels");
    v.number("rolling_shutter_s", rolling_shutter_s, 0, 1,
             "read-out of the image, first row to last, seconds; 0: all at once");
    v.number("exposure_s", exposure_s, 0, 1, "each row gathers light for this long, seconds; 0: an instant");
  }
  double noise_sigma = 1.0;
  double rolling_shutter_s = 0, exposure_s = 0;
};

struct MotionParams {
  std::string kind = "drive";
  /// Metres per second.
  double speed = 9;
  /// Height over the ground (drive), metres.
  double height = 1.65;
  /// Offset to the right of the waypoints (drive), metres.
  double lane_offset = 0;
  /// Radius of turns (drive), metres.
  double turn_radius = 8;
  /// Largest acceleration, sideways in turns and along the path (drive), m/s^2.
  double acceleration = 2.5;
  /// Direction of view to the right of the direction of travel (drive), degrees.
  double look_right_deg = 0;
  /// Direction of view below the horizon (drive), degrees.
  double look_down_deg = 0;
  /// Angle by which the camera is held rolled clockwise (drive), degrees.
  double roll_deg = 0;
  /// Standard deviation of pitch and roll, degrees; that of yaw is a third of it.
  double sway_deg = 0.25;
  /// Standard deviation of the height (drive), metres.
  double sway_m = 0.01;
  /// Typical frequency of the sway, Hz.
  double sway_hz = 1.2;
  /// Share of the path at which the pure rotation happens (drive), 0 to 1.
  double pause_at = 0.5;
  /// Angle of the pure rotation, to the left, degrees; 0: none.
  double pause_turn_deg = 0;
  /// Rate of the pure rotation, degrees per second.
  double pause_rate_deg = 30;
  /// Half the range of the movement (hand), metres.
  double amplitude = 0.3;
  /// Standard deviation of the direction of view to the sides (drive), degrees, and its typical frequency.
  double glance_deg = 0, glance_hz = 0.1;
  /// Number of times that the path is driven (drive): forwards, then backwards without turning round, ...
  int legs = 1;
  /// Time in which the motion is reversed at the end of a leg (drive), seconds.
  double reversal_s = 1;
  /// Waypoint, from 0, at which the second lap begins (drive); 0: there is none.
  int second_lap = 0;
  /// Offset of the second lap to the right, beyond that of the first (drive), metres.
  double second_offset = 0;
  void visit(KeyVisitor& v) {
    v.text("kind", kind, {"drive", "hand"},
           "drive along waypoints, or move about the first one looking at the second");
    v.number("speed", speed, 0.01, 60, "metres a second");
    v.number("height", height, 0.05, 50, "drive: metres over the ground");
    v.number("lane_offset", lane_offset, -50, 50, "drive: metres to the right of the waypoints");
    v.number("turn_radius", turn_radius, 0.2, 500, "drive: metres");
    v.number("acceleration", acceleration, 0.05, 20, "drive: m/s^2, sideways in turns and along the path");
    v.number("look_right_deg", look_right_deg, -180, 180, "drive: degrees between the path and the view");
    v.number("look_down_deg", look_down_deg, -80, 80, "drive: degrees under the horizon");
    v.number("roll_deg", roll_deg, -180, 180, "drive: degrees by which the camera is rolled clockwise");
    v.number("sway_deg", sway_deg, 0, 20, "standard deviation of pitch and roll");
    v.number("sway_m", sway_m, 0, 1, "drive: standard deviation of the height, metres");
    v.number("sway_hz", sway_hz, 0.01, 20, "typical frequency of the sway");
    v.number("pause_at", pause_at, 0, 1, "drive: share of the path where it stops to turn");
    v.number("pause_turn_deg", pause_turn_deg, -720, 720, "drive: pure rotation, to the left; 0: none");
    v.number("pause_rate_deg", pause_rate_deg, 0.1, 360, "drive: degrees a second of that turn");
    v.number("amplitude", amplitude, 0.001, 100, "hand: half the range of the movement, metres");
    v.number("glance_deg", glance_deg, 0, 60, "drive: standard deviation of the view to the sides");
    v.number("glance_hz", glance_hz, 0.01, 20, "drive: typical frequency of these glances");
    v.integer("legs", legs, 1, 100, "drive: forwards, back without turning round, forwards, ...");
    v.number("reversal_s", reversal_s, 0.05, 10, "drive: seconds in which the motion is reversed");
    v.integer("second_lap", second_lap, 0, 10000, "drive: waypoint, from 0, where the second lap begins");
    v.number("second_offset", second_offset, -100, 100,
             "drive: metres to the right, added to lane_offset on the second lap");
  }
};

struct WorldParams {
  std::string kind = "street";
  /// Kinds of texture, separated by blanks.
  std::string walls = "brick plaster stone boards";
  std::string sky = "clouds";
  double horizon_gray = 222;
  double haze_per_metre = 0.0015;
  double sun_azimuth_deg = 130, sun_elevation_deg = 42;
  /// Density of objects.
  double density = 1;
  /// Season of a lakeshore: leaves, sun and haze (season.h); empty: none.
  std::string season;
  void visit(KeyVisitor& v) {
    v.text("kind", kind,
           {"street", "mirrored_street", "desk", "lakeshore", "corridor", "identical_doors", "plaza",
            "motorway", "tiled_rooms", "open_land", "parked_cars"},
           "what is built; of the last three the seed draws camera, motion and light, too");
    v.text("walls", walls, {}, "kinds of texture for walls, separated by blanks");
    v.text("sky", sky, {}, "kind of texture for the sky; empty: plain");
    v.number("horizon_gray", horizon_gray, 0, 255, "gray of the sky at the horizon, which haze fades to");
    v.number("haze_per_metre", haze_per_metre, 0, 1,
             "a surface at z metres keeps 1/(1 + haze z) of its brightness");
    v.number("sun_azimuth_deg", sun_azimuth_deg, -360, 360, "from the x axis to the left");
    v.number("sun_elevation_deg", sun_elevation_deg, 5, 90, "over the horizon");
    v.number("density", density, 0, 3, "how many cars, trees and other objects there are");
    v.text("season", season, {"", "spring", "summer", "autumn", "winter"},
           "lakeshore: leaves, light and haze of a season");
  }
};

/// Light of the second lap. It takes the place of that of the world, whose shadows on the ground move, too.
struct SecondLightParams {
  /// Time at which the light begins to change, seconds; 0: it does not.
  double begins_s = 0;
  /// Time that the change takes, seconds.
  double duration_s = 10;
  double sun_azimuth_deg = 130, sun_elevation_deg = 42;
  /// Brightness of a surface in the shade, and what a sun straight above it adds; factors on its gray.
  double shade = 0.62, sun = 0.5;
  /// Factor on the gray of the whole image.
  double exposure = 1;
  double horizon_gray = 222;
  double haze_per_metre = 0.0015;
  void visit(KeyVisitor& v) {
    v.number("begins_s", begins_s, 0, 1e6, "seconds of the scene; 0: the light does not change");
    v.number("duration_s", duration_s, 0, 1e6, "seconds that the change takes");
    v.number("sun_azimuth_deg", sun_azimuth_deg, -360, 360, "from the x axis to the left");
    v.number("sun_elevation_deg", sun_elevation_deg, 5, 90, "over the horizon");
    v.number("shade", shade, 0.05, 2, "brightness in the shade; of the world's light 0.62");
    v.number("sun", sun, 0, 2, "what a sun straight above a surface adds; of the world's light 0.5");
    v.number("exposure", exposure, 0.1, 4, "factor on the gray of the image");
    v.number("horizon_gray", horizon_gray, 0, 255, "gray of the sky at the horizon, which haze fades to");
    v.number("haze_per_metre", haze_per_metre, 0, 1, "as in the group world");
  }
};

/// Leg between two points of the ground plan, metres.
struct Leg {
  Eigen::Vector2d from, to;
};

/// Lines such as "street.yaml:31" to which errors detected later refer.
struct SceneLines {
  std::string waypoints, walls, sky;
};

struct SceneParams {
  int seed = 1;
  int frames = 0;
  double rate_hz = 10;
  CameraParams camera;
  MotionParams motion;
  WorldParams world;
  SecondLightParams second_light;
  /// Waypoints, metres.
  std::vector<Eigen::Vector3d> waypoints;
  /// Middle lines of the world's streets or corridors; empty: the legs between the waypoints.
  std::vector<Leg> streets;
  SceneLines where;
  void visit(KeyVisitor& v) {
    v.integer("seed", seed, 0, 1000000000, "everything random follows from it");
    v.integer("frames", frames, 1, 1000000, "number of images");
    v.number("rate_hz", rate_hz, 0.1, 1000, "images a second");
    {
      auto group = v.group("camera");
      camera.visit(v);
    }
    {
      auto group = v.group("motion");
      motion.visit(v);
    }
    {
      auto group = v.group("world");
      world.visit(v);
    }
    auto group = v.group("second_light");
    second_light.visit(v);
  }
};

/// The legs between the waypoints.
std::vector<Leg> legs_between(const std::vector<Eigen::Vector3d>& waypoints);
/// The streets of the scene, or the legs between its waypoints if it names none.
std::vector<Leg> street_legs(const SceneParams& params);

/// Parses the text of a scene file. Throws InputError: unknown key, value out of range, no frames, waypoints
/// that are not lists of two or three numbers, streets that are not lists of four, fewer than two waypoints,
/// no camera. Each message opens with `file` and, if there is one, the line.
SceneParams parse_scene(const std::string& text, const std::string& file);

}  // namespace edgevo
