// SPDX-License-Identifier: BSD-3-Clause
#include "traffic_bodies.h"

#include "props.h"

namespace edgevo {
namespace {

const Eigen::Vector3d kSun(0.4, 0.5, 0.75);

// Out is to the left of the body, so that right is back.
LocalFrame own_axes() {
  return {Eigen::Vector3d::Zero(), -Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
}

WorldBuilder builder(uint64_t seed) { return WorldBuilder(seed, "traffic", kSun); }

// Half a length, half a width, the heights of bottom and top.
struct Hull {
  double length, width, bottom, top;
};

void add_hull(WorldBuilder& b, const Hull& h, int side, int end) {
  const Eigen::Vector3d down(0, 0, h.bottom - h.top), back(-2 * h.length, 0, 0), left(0, 2 * h.width, 0);
  b.fit({h.length, h.width, h.top}, back, down, side);
  b.fit({-h.length, -h.width, h.top}, -back, down, side);
  b.fit({h.length, -h.width, h.top}, left, down, end);
  b.fit({-h.length, h.width, h.top}, -left, down, end);
  b.fit({-h.length, h.width, h.top}, -back, -left, b.texture("metal", 3));
}

std::shared_ptr<const World> finished(WorldBuilder& b) { return std::make_shared<const World>(b.finish()); }

}  // namespace

std::shared_ptr<const World> traffic_car(uint64_t seed) {
  WorldBuilder b = builder(seed);
  add_car(b, own_axes());
  return finished(b);
}

std::shared_ptr<const World> traffic_lorry(uint64_t seed) {
  WorldBuilder b = builder(seed);
  add_hull(b, {4.5, 1.25, 0.4, 3}, b.texture("metal", 5), b.texture("lorry_rear", 0));
  return finished(b);
}

std::shared_ptr<const World> traffic_bus(uint64_t seed) {
  WorldBuilder b = builder(seed);
  add_hull(b, {6, 1.25, 0.1, 3.1}, b.texture("bus_side", 0), b.texture("lorry_rear", 1));
  return finished(b);
}

std::shared_ptr<const World> traffic_person(uint64_t seed) {
  WorldBuilder b = builder(seed);
  b.card(own_axes(), 0.6, 1.75, M_PI / 2, b.texture("person", 0));
  b.card(own_axes(), 0.4, 1.75, 0, b.texture("person", 1));
  return finished(b);
}

}  // namespace edgevo
