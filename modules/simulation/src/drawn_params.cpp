// SPDX-License-Identifier: BSD-3-Clause
#include "drawn_params.h"

#include <cmath>

#include "edgevo/core/angle.h"
#include "room_plan.h"

namespace edgevo {
namespace {
constexpr uint64_t kDrawnPurpose = 0x647261776e;  // a stream of its own for these parameters

struct Range {
  double low, high;
  double draw(Random& random) const { return random.uniform(low, high); }
};

// A lens with that horizontal field of view, degrees; slight barrel distortion as in common lenses.
void draw_camera(Random& random, const Range& view_deg, CameraParams* camera) {
  constexpr Range kNoise{0.8, 2.5};           // gray levels
  constexpr Range kBarrel{-0.06, 0.01};       // k1
  constexpr Range kOffCentre{-0.012, 0.012};  // principal point, share of the width
  Pinhole p = camera->camera.pinhole();
  p.fx = p.fy = 0.5 * p.width / std::tan(0.5 * rad(view_deg.draw(random)));
  p.cx = 0.5 * (p.width - 1) + kOffCentre.draw(random) * p.width;
  p.cy = 0.5 * (p.height - 1) + kOffCentre.draw(random) * p.width;
  Distortion d;
  d.k1 = kBarrel.draw(random);
  camera->camera = Camera(p, d);
  camera->noise_sigma = kNoise.draw(random);
}

void draw_sun(Random& random, const Range& elevation_deg, WorldParams* world) {
  world->sun_azimuth_deg = random.uniform(-180, 180);
  world->sun_elevation_deg = elevation_deg.draw(random);
}

void draw_outdoor_light(Random& random, WorldParams* world) {
  draw_sun(random, {12, 65}, world);
  world->sky = random.uniform() < 0.75 ? "clouds" : "";  // else an even gray
  world->horizon_gray = random.uniform(185, 245);
  world->haze_per_metre = random.uniform(0.0003, 0.003);
}

double sign_of(Random& random) { return random.uniform() < 0.5 ? -1 : 1; }

void draw_rooms(Random& random, uint64_t seed, const std::string& where, SceneParams* params) {
  draw_camera(random, {70, 95}, &params->camera);
  draw_sun(random, {30, 80}, &params->world);
  params->world.sky.clear();
  params->world.horizon_gray = random.uniform(60, 200);  // outside of the windows
  params->world.haze_per_metre = 0;
  params->world.density = random.uniform(0.15, 1.1);
  MotionParams& m = params->motion;
  m.speed = random.uniform(0.7, 1.2);
  m.height = random.uniform(1.2, 1.75);
  m.turn_radius = random.uniform(0.45, 0.8);
  m.acceleration = random.uniform(0.15, 0.7);  // in turns 25 to 70 degrees a second
  // Held level by half of the walkers, tilted towards the floor and to a side by the others.
  const bool is_tilted = random.uniform() < 0.5;
  m.look_down_deg = is_tilted ? random.uniform(10, 38) : random.uniform(0, 15);
  m.roll_deg = is_tilted ? random.uniform(-30, 30) : random.uniform(-3, 3);
  m.sway_deg = random.uniform(2, 11);
  m.sway_m = random.uniform(0.01, 0.05);
  m.sway_hz = random.uniform(0.12, 0.3);
  m.glance_deg = random.uniform(5, 30);
  m.glance_hz = random.uniform(0.1, 0.25);
  const RoomPlan plan = plan_rooms(*params, seed, where);
  params->waypoints = plan.waypoints;
  params->frames = plan.frames;
}

// Two straights joined by a bend of `angle` radians in short pieces.
std::vector<Eigen::Vector3d> road_with_bend(double before, double angle, double after) {
  constexpr int kPieces = 4;
  constexpr double kPiece = 8;  // metres
  std::vector<Eigen::Vector3d> points{{0, 0, 0}, {before, 0, 0}};
  for (int i = 1; i <= kPieces; ++i) {
    const double direction = angle * i / kPieces, length = i < kPieces ? kPiece : after;
    points.push_back(points.back() + length * Eigen::Vector3d(std::cos(direction), std::sin(direction), 0));
  }
  return points;
}

void draw_open_land(Random& random, const std::string&, SceneParams* params) {
  draw_camera(random, {65, 85}, &params->camera);
  draw_outdoor_light(random, &params->world);
  params->world.density = random.uniform(0.5, 1.2);
  MotionParams& m = params->motion;
  const double step_m = random.uniform(0.7, 1.2);  // between frames
  const int frames_per_leg = 60 + random.below(21);
  m.legs = 6;
  m.reversal_s = random.uniform(0.5, 2.5);
  m.speed = step_m * params->rate_hz;
  m.height = random.uniform(1.3, 2.1);
  m.lane_offset = sign_of(random) * random.uniform(1.4, 1.9);
  m.turn_radius = random.uniform(60, 100);
  m.look_down_deg = random.uniform(-1, 4);
  m.sway_deg = random.uniform(0.1, 0.5);
  m.sway_m = random.uniform(0.005, 0.02);
  m.sway_hz = random.uniform(0.8, 1.6);
  params->frames = m.legs * frames_per_leg;
  const double length = step_m * frames_per_leg, bend = sign_of(random) * rad(random.uniform(0, 14));
  params->waypoints = road_with_bend(random.uniform(0.5, 0.7) * length, bend, length);
}

void draw_parked_cars(Random& random, const std::string&, SceneParams* params) {
  draw_camera(random, {60, 85}, &params->camera);
  draw_outdoor_light(random, &params->world);
  params->world.density = random.uniform(0.5, 1.2);
  MotionParams& m = params->motion;
  const double side = sign_of(random), length = random.uniform(80, 100);
  params->frames = 150 + random.below(51);
  m.speed = length / params->frames * params->rate_hz;
  m.height = random.uniform(1.2, 2.2);
  m.turn_radius = 200;
  m.look_right_deg = side * random.uniform(78, 102);
  m.look_down_deg = random.uniform(-2, 6);
  m.sway_deg = random.uniform(0.1, 0.7);
  m.sway_m = random.uniform(0.005, 0.02);
  m.sway_hz = random.uniform(0.8, 1.6);
  // Metres to the right and to the left, by which the drive leaves the straight line of the cars.
  const double bow = random.uniform(-0.5, 0.5);
  params->waypoints = {{0, 0, 0}, {0.5 * length, bow, 0}, {length + 5, 0, 0}};
}

}  // namespace

bool is_drawn(const std::string& kind) {
  return kind == "tiled_rooms" || kind == "open_land" || kind == "parked_cars";
}

void draw_params(uint64_t seed, const std::string& where, SceneParams* params) {
  Random random = Random::derive(seed, kDrawnPurpose);
  params->motion = MotionParams();
  if (params->world.kind == "tiled_rooms") draw_rooms(random, seed, where, params);
  if (params->world.kind == "open_land") draw_open_land(random, where, params);
  if (params->world.kind == "parked_cars") draw_parked_cars(random, where, params);
}

}  // namespace edgevo
