// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/traffic.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "edgevo/core/error.h"
#include "edgevo/core/random.h"
#include "road.h"
#include "traffic_bodies.h"

namespace edgevo {
namespace {

constexpr double kShortest = 10;    // metres of a path
constexpr double kNextLane = 3;     // metres to the left
constexpr double kStopsBefore = 6;  // metres before the camera turns
constexpr double kCarSpeed = 9;     // m/s
constexpr double kStands = 8;       // seconds, for the bus
constexpr uint64_t kPurpose = 0x74726166666963;

using SharedRoad = std::shared_ptr<const Road>;

// Smooth from 0 to 1.
double ease(double t) { return t <= 0 ? 0 : t >= 1 ? 1 : t * t * (3 - 2 * t); }

// Traffic of one kind in the making.
struct Traffic {
  Scene& scene;
  SharedRoad road;
  Random random;

  double end() const { return scene.times.back().seconds(); }
  void add(std::shared_ptr<const World> parts, std::function<SE3(double)> T_scene_body) {
    scene.bodies.push_back({std::move(parts), std::move(T_scene_body)});
  }
  // `left` of the path, metres; `along` gives metres along it at a time. The body looks along the path, or
  // against it.
  void add_on_road(std::shared_ptr<const World> parts, double left, std::function<double(double)> along) {
    add(std::move(parts), [road = road, left, along](double t) { return road->at(along(t), left); });
  }
  void add_towards(std::shared_ptr<const World> parts, double left, std::function<double(double)> along) {
    const SE3 turned(Eigen::Matrix3d(Eigen::Vector3d(-1, -1, 1).asDiagonal()), Eigen::Vector3d::Zero());
    add(std::move(parts),
        [road = road, left, along, turned](double t) { return road->at(along(t), left) * turned; });
  }
};

// Metres from the camera to the rear of what it catches up with and follows.
double gap_to_lorry(double seconds) {
  constexpr double kPeriod = 26, kFar = 60, kNear = 6;  // it never drives backwards
  const double t = std::fmod(seconds, kPeriod);
  return kFar + (kNear - kFar) * (ease(t / 10) - ease((t - 14) / 10));
}

constexpr double kHalfLorry = 4.5;  // metres

void add_lorry(Traffic& traffic) {
  const SharedRoad road = traffic.road;
  traffic.add_on_road(traffic_lorry(traffic.random.next()), 0,
                      [road](double t) { return road->gone(t) + gap_to_lorry(t) + kHalfLorry; });
}

void add_overtaking(Traffic& traffic) {
  const SharedRoad road = traffic.road;
  constexpr double kFaster = 5, kEvery = 6;  // m/s, seconds
  for (double passes = 4; passes < traffic.end(); passes += kEvery)
    traffic.add_on_road(traffic_car(traffic.random.next()), kNextLane,
                        [road, passes](double t) { return road->gone(t) + kFaster * (t - passes); });
}

void add_oncoming(Traffic& traffic) {
  constexpr double kEvery = 3.5;  // seconds
  for (double meets = 2.5; meets < traffic.end() + 3; meets += kEvery) {
    const double at = traffic.road->gone(meets);
    traffic.add_towards(traffic_car(traffic.random.next()), kNextLane,
                        [at, meets](double t) { return at - kCarSpeed * (t - meets); });
  }
}

// A body that is at the corner at a time; it drives on the right.
void add_across(Traffic& traffic, std::shared_ptr<const World> parts, const Turning& at, double seconds,
                double speed, int way) {
  const Eigen::Vector2d forward = way * at.onwards, right(forward.y(), -forward.x());
  traffic.add(std::move(parts), [=](double t) {
    return on_ground(at.corner + 0.5 * kNextLane * right + speed * (t - seconds) * forward, forward);
  });
}

std::vector<Turning> turnings_of(const Traffic& traffic) {
  std::vector<Turning> turnings = traffic.road->turnings();
  if (turnings.empty())
    throw InputError("scene " + traffic.scene.name, "its path has no turn where traffic could cross",
                     "give another scene or kind of traffic");
  return turnings;
}

void add_crossing(Traffic& traffic) {
  for (const Turning& turning : turnings_of(traffic)) {
    int way = 1;
    for (const double before : {4.2, 3.2, 2.2, 1.2}) {
      add_across(traffic, traffic_car(traffic.random.next()), turning, turning.seconds - before, kCarSpeed,
                 way);
      way = -way;
    }
  }
}

void add_bus(Traffic& traffic) {
  const Turning turning = turnings_of(traffic).front();
  const double at = turning.seconds - kStopsBefore / kCarSpeed;
  stop_camera(at, kStands, &traffic.scene);
  traffic.road = std::make_shared<const Road>(traffic.scene);
  const double stands = at + 1;  // half of the time in which it slows down
  add_across(traffic, traffic_bus(traffic.random.next()), turning, stands + 0.45 * kStands, 5, 1);
  add_across(traffic, traffic_car(traffic.random.next()), turning, stands + 0.5 * kStands, kCarSpeed, -1);
}

void add_stop_and_go(Traffic& traffic) {
  constexpr double kEvery = 8, kStop = 2.5, kGap = 7, kEarlier = 0.7;  // seconds, metres
  const double end = traffic.end();
  const int stops = int((end - 4) / kEvery) + 1;
  for (int n = 0; n < stops; ++n) stop_camera(5 + n * (kEvery + 2 + kStop), kStop, &traffic.scene);
  const SharedRoad road = std::make_shared<const Road>(traffic.scene);
  traffic.road = road;
  traffic.add_on_road(traffic_lorry(traffic.random.next()), 0,
                      [road](double t) { return road->gone(t + kEarlier) + kGap + kHalfLorry; });
}

void add_people(Traffic& traffic) {
  const SharedRoad road = traffic.road;
  constexpr double kSpeed = 1.3, kEvery = 4, kAside = 0.6;  // m/s, seconds, metres
  double left = kAside;
  for (double meets = 4; meets < traffic.end() + 5; meets += kEvery, left = -left) {
    const double at = road->gone(meets);
    traffic.add_towards(traffic_person(traffic.random.next()), left,
                        [at, meets](double t) { return at - kSpeed * (t - meets); });
  }
  traffic.add_on_road(traffic_person(traffic.random.next()), -0.2,
                      [road](double t) { return road->gone(t) + 3 + 1.2 * std::sin(0.8 * t); });
}

using Adder = void (*)(Traffic&);
const std::vector<std::pair<std::string, Adder>>& adders() {
  static const std::vector<std::pair<std::string, Adder>> all{
      {"lorry", add_lorry},       {"overtaking", add_overtaking},
      {"oncoming", add_oncoming}, {"crossing", add_crossing},
      {"bus", add_bus},           {"stop-and-go", add_stop_and_go},
      {"people", add_people}};
  return all;
}

}  // namespace

const std::vector<std::string>& traffic_kinds() {
  static const std::vector<std::string> kinds = [] {
    std::vector<std::string> names;
    for (const auto& [name, add] : adders()) names.push_back(name);
    return names;
  }();
  return kinds;
}

void add_traffic(const std::string& kind, Scene* scene) {
  const auto found =
      std::find_if(adders().begin(), adders().end(), [&](const auto& known) { return known.first == kind; });
  if (found == adders().end())
    throw InputError("--traffic " + kind, "is not a kind of traffic",
                     "did you mean " + nearest_name(kind, traffic_kinds()) + "?");
  Traffic traffic{*scene, std::make_shared<const Road>(*scene), Random::derive(scene->seed, kPurpose)};
  if (traffic.road->length() < kShortest)
    throw InputError("scene " + scene->name, "the camera goes less than 10 m: there is no road for traffic",
                     "give a scene with a drive, such as street");
  found->second(traffic);
  scene->traffic.push_back(kind);
}

}  // namespace edgevo
