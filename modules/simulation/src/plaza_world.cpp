// SPDX-License-Identifier: BSD-3-Clause
// A square among houses, with trees, benches, cars and a monument; the waypoints lie inside.
#include <cmath>

#include "props.h"
#include "street_plan.h"
#include "worlds.h"

namespace edgevo {
namespace {

constexpr double kMargin = 17;  // from the path to the houses, metres

void add_bench(WorldBuilder& b, const LocalFrame& place) {
  const int wood = b.texture("wood", 1), metal = b.texture("metal", 1);
  b.box(place, {-0.9, 0.9, -0.2, 0.2, 0.42, 0.46}, wood, wood, -1, true, 0.9f);
  b.box(place, {-0.9, 0.9, -0.26, -0.22, 0.5, 0.9}, wood, wood, -1, true, 0.8f);
  for (double r : {-0.8, 0.74})
    b.box(place, {r, r + 0.06, -0.25, 0.2, 0, 0.42}, metal, metal, -1, false, 0.4f);
}

void add_monument(WorldBuilder& b, const LocalFrame& place) {
  const int stone = b.texture("stone", 0), rock = b.texture("rock", 0);
  for (int i = 0; i < 3; ++i) {
    const double half = 2.2 - 0.5 * i;
    b.box(place, {-half, half, -half, half, 0.3 * i, 0.3 * (i + 1)}, stone, stone);
  }
  b.box(place, {-0.7, 0.7, -0.7, 0.7, 0.9, 2.4}, stone, stone, b.texture("poster", 0));
  b.prism(place.moved(0, 0, 2.4), 0.45, 2.2, 9, rock);
}

struct Box2 {
  Eigen::Vector2d low, high;
};

Box2 around(const std::vector<Eigen::Vector3d>& waypoints) {
  Box2 box{waypoints[0].head<2>(), waypoints[0].head<2>()};
  for (const Eigen::Vector3d& p : waypoints)
    box.low = box.low.cwiseMin(p.head<2>()), box.high = box.high.cwiseMax(p.head<2>());
  box.low.array() -= kMargin, box.high.array() += kMargin;
  return box;
}

// One row of houses along a side of the square: `place` looks inwards, with its origin at the left end.
void add_row(Site& site, const LocalFrame& place, double length) {
  Random& random = site.build.random();
  for (double r = 0; r < length;) {
    const double width = random.uniform(7, 12);
    const std::string& wall = site.walls[size_t(random.below(int(site.walls.size())))];
    add_house(site.build, place.moved(r, -random.uniform(0, 1.5), 0), width, 9, 2 + random.below(3), wall);
    r += width + (random.uniform() < 0.3 ? random.uniform(1, 3) : 0);
  }
}

double distance_to_path(const std::vector<Eigen::Vector3d>& waypoints, const Eigen::Vector2d& p) {
  const std::vector<Street> legs = streets_of(waypoints, 0, 0, 0);
  double nearest = 1e9;
  for (const Street& leg : legs) nearest = std::min(nearest, leg.distance(p));
  return nearest;
}

void scatter(Site& site, const Box2& box) {
  WorldBuilder& b = site.build;
  Random& random = b.random();
  const int count = int(30 * site.params.world.density);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector2d p(random.uniform(box.low.x() + 3, box.high.x() - 3),
                            random.uniform(box.low.y() + 3, box.high.y() - 3));
    const double what = random.uniform(), angle = random.uniform(0, 2 * M_PI);
    if (distance_to_path(site.params.waypoints, p) < 4.5) continue;
    const LocalFrame place = facing({p.x(), p.y(), 0}, angle);
    if (what < 0.4)
      add_tree(b, place, random.uniform(5, 9));
    else if (what < 0.55)
      add_bench(b, place);
    else if (what < 0.7)
      add_lamp(b, place);
    else if (what < 0.8)
      add_sign(b, place);
    else
      add_car(b, place);
  }
}

}  // namespace

void build_plaza(Site& site) {
  WorldBuilder& b = site.build;
  const Box2 box = around(site.params.waypoints);
  const double w = box.high.x() - box.low.x(), h = box.high.y() - box.low.y();
  for (double x = box.low.x() - 10; x < box.high.x() + 10; x += 16)
    for (double y = box.low.y() - 10; y < box.high.y() + 10; y += 16)
      b.tile({x, y + 16, 0}, {16, 0, 0}, {0, -16, 0}, b.texture("slabs", 0)).uv_origin = {0, 0};
  add_row(site, facing({box.low.x(), box.high.y(), 0}, -M_PI / 2), w);
  add_row(site, facing({box.high.x(), box.low.y(), 0}, M_PI / 2), w);
  add_row(site, facing({box.low.x(), box.low.y(), 0}, 0), h);
  add_row(site, facing({box.high.x(), box.high.y(), 0}, M_PI), h);
  const Eigen::Vector2d middle = 0.5 * (box.low + box.high);
  add_monument(b, facing({middle.x() + 5, middle.y() + 9, 0}, 0.4));
  scatter(site, box);
}

}  // namespace edgevo
