// SPDX-License-Identifier: BSD-3-Clause
// A desk in a room. The second waypoint is where one looks: the middle of the desk.
#include <algorithm>
#include <cmath>

#include "worlds.h"

namespace edgevo {
namespace {

// The walls of the room, from the middle of the desk, metres.
constexpr double kBack = -1.5, kSide = 3.2, kFront = 4.5;

class DeskBuilder {
 public:
  explicit DeskBuilder(Site& site)
      : site_(site), b_(site.build), random_(b_.random()), centre_(site.params.waypoints[1]) {
    const Eigen::Vector3d eye = site.params.waypoints[0] - centre_;
    desk_ = facing({centre_.x(), centre_.y(), 0}, std::atan2(eye.y(), eye.x()));
    top_ = centre_.z();
  }

  void build() {
    room();
    table();
    monitors();
    things();
    furniture();
    if (site_.params.waypoints.size() > 2) other_walls();
  }

 private:
  // `desk_`: the origin is below the middle of the desk, `out` points at the person.
  void room() {
    const int wall = b_.texture(site_.walls.front(), 0), floor = b_.texture("carpet", 0),
              wood = b_.texture("wood", 1);
    const double back = kBack, side = kSide, front = kFront, height = 2.8;
    b_.tile(desk_.point(-side, back, 0), 2 * side * desk_.right, (front - back) * desk_.out, floor);
    b_.tile(desk_.point(-side, front, height), 2 * side * desk_.right, -(front - back) * desk_.out, wall)
        .gain = 1.1f;
    b_.wall(desk_, -side, side, 0, height, back, wall, true);
    b_.tile(desk_.point(-side, front, height), -(front - back) * desk_.out, {0, 0, -height}, wall).gain =
        0.85f;
    b_.tile(desk_.point(side, back, height), (front - back) * desk_.out, {0, 0, -height}, wall).gain = 1.0f;
    b_.tile(desk_.point(side, front, height), -2 * side * desk_.right, {0, 0, -height}, wall);
    b_.wall(desk_, -side, side, 0, 0.12, back + 0.02, wood, true);
    for (double r : {-2.6, -1.7, 1.25, 2.15}) {
      const double z = 1.15 + random_.uniform(-0.1, 0.15);
      b_.wall(desk_, r, r + 0.65, z, z + 1.2, back + 0.01, b_.any_texture("poster", 6), false);
    }
    b_.wall(desk_, -0.75, 0.75, 1.2, 2.4, back + 0.015, b_.texture("window", 3), false).gain = 1.3f;
  }

  void table() {
    const int wood = b_.texture("wood", 0);
    b_.box(desk_, {-0.95, 0.95, -0.5, 0.5, top_ - 0.04, top_}, wood, wood);
    for (double r : {-0.88, 0.82})
      for (double o : {-0.44, 0.38})
        b_.box(desk_, {r, r + 0.06, o, o + 0.06, 0, top_ - 0.04}, wood, wood, -1, true, 0.7f);
    const int metal = b_.texture("metal", 1);
    b_.box(desk_, {0.45, 0.85, -0.42, 0.4, 0, top_ - 0.1}, metal, metal);  // drawers
  }

  LocalFrame on_desk(double r, double o, double angle) const { return desk_.moved(r, o, top_, angle); }

  void monitors() {
    const int dark = b_.texture("metal", 2);
    for (int i = 0; i < 2; ++i) {
      const LocalFrame p = on_desk(i == 0 ? -0.33 : 0.27, -0.28, i == 0 ? 0.12 : -0.15);
      b_.box(p, {-0.27, 0.27, -0.04, 0.02, 0.12, 0.46}, dark, dark, b_.texture("screen", i), false, 0.45f);
      b_.box(p, {-0.04, 0.04, -0.06, -0.04, 0, 0.3}, dark, dark, -1, false, 0.4f);
      b_.box(p, {-0.13, 0.13, -0.12, 0.08, 0, 0.015}, dark, dark, -1, false, 0.4f);
    }
    const LocalFrame p = on_desk(-0.2, 0.12, 0.05);
    b_.box(p, {-0.22, 0.22, -0.08, 0.08, 0, 0.022}, dark, b_.texture("keyboard", 0), -1, false, 1.0f);
    b_.box(on_desk(0.14, 0.14, -0.2), {-0.03, 0.03, -0.05, 0.05, 0, 0.03}, dark, dark, -1, false, 0.5f);
  }

  void sheet(const LocalFrame& p, double w, double h, double z, const char* kind, int variant) {
    b_.fit(p.point(-w / 2, -h / 2, z), w * p.right, h * p.out, b_.texture(kind, variant));
  }

  void books(const LocalFrame& p, int count) {
    double z = 0;
    for (int i = 0; i < count; ++i) {
      const double h = random_.uniform(0.015, 0.045), w = random_.uniform(0.15, 0.22), d = w * 1.35;
      const int cover = b_.any_texture("book", 8), spine = b_.any_texture("metal", 12);
      b_.box(
          p.moved(random_.uniform(-0.02, 0.02), random_.uniform(-0.02, 0.02), 0, random_.uniform(-0.3, 0.3)),
          {-w / 2, w / 2, -d / 2, d / 2, z, z + h}, spine, cover, -1, false,
          float(random_.uniform(0.8, 1.2)));
      z += h;
    }
  }

  void mug(const LocalFrame& p) {
    const int skin = b_.any_texture("mug", 3);
    b_.prism(p, 0.042, 0.1, 12, skin);
    b_.box(p, {0.035, 0.07, -0.008, 0.008, 0.02, 0.08}, b_.texture("metal", 3), b_.texture("metal", 3), -1,
           false);
    const Eigen::Vector3d r = 0.029 * p.right, o = 0.029 * p.out;
    b_.fit(p.point(0, 0, 0.085) - r - o, 2 * r, 2 * o, b_.texture("metal", 4)).gain *= 0.35f;
  }

  void things() {
    for (int i = 0; i < 7; ++i)
      sheet(on_desk(random_.uniform(-0.8, 0.8), random_.uniform(-0.1, 0.36), random_.uniform(-0.6, 0.6)),
            0.21, 0.297, 0.002 + 0.001 * i, "paper", i);
    books(on_desk(-0.75, -0.2, 0.3), 4);
    books(on_desk(0.72, 0.08, -0.4), 5);
    books(on_desk(0.42, 0.33, 0.9), 2);
    mug(on_desk(0.3, 0.05, 0.4));
    mug(on_desk(-0.55, 0.22, 2.0));
    const int box = b_.texture("box", 0), other = b_.texture("box", 1);
    b_.box(on_desk(0.68, -0.3, -0.5), {-0.13, 0.13, -0.1, 0.1, 0, 0.2}, box, box, -1, false);
    b_.box(on_desk(-0.72, 0.15, 0.4), {-0.08, 0.08, -0.06, 0.06, 0, 0.1}, other, other, -1, false);
    for (int i = 0; i < 9; ++i) {  // pens
      const LocalFrame p =
          on_desk(random_.uniform(-0.6, 0.75), random_.uniform(0.0, 0.4), random_.uniform(0, 3.1));
      const int skin = b_.any_texture("metal", 12);
      b_.box(p, {-0.07, 0.07, -0.004, 0.004, 0.008, 0.016}, skin, skin, -1, false,
             float(random_.uniform(0.3, 1.3)));
    }
    b_.prism(on_desk(0.5, -0.12, 0), 0.035, 0.1, 8, b_.texture("metal", 5), 0.6f);  // pencil cup
    for (int i = 0; i < 6; ++i)
      b_.prism(on_desk(0.5 + random_.uniform(-0.02, 0.02), -0.12 + random_.uniform(-0.02, 0.02), 0), 0.004,
               random_.uniform(0.14, 0.19), 5, b_.any_texture("metal", 12), float(random_.uniform(0.4, 1.4)));
  }

  void furniture() {
    const int wood = b_.texture("wood", 2);
    b_.box(desk_, {-2.9, -1.5, -1.45, -1.1, 0, 1.1}, wood, wood, b_.texture("shelf", 0));
    b_.box(desk_, {1.5, 2.9, -1.45, -1.1, 0, 1.0}, wood, wood, b_.texture("shelf", 1));
    for (int i = 0; i < 6; ++i) {
      const double size = random_.uniform(0.2, 0.4);
      const int skin = b_.any_texture("box", 3);
      b_.box(desk_.moved(random_.uniform(-2.6, -1.3), random_.uniform(-0.8, 1.2), 0, random_.uniform(-1, 1)),
             {-size / 2, size / 2, -size / 2, size / 2, 0, size}, skin, skin, -1, false);
    }
    const int plant = b_.texture("bush", 0);
    for (int i = 0; i < 3; ++i) b_.card(desk_.moved(-2.2, -1.28, 1.1), 0.7, 0.6, 1.05 * i, plant);
    for (int i = 0; i < 3; ++i)
      b_.card(desk_.moved(1.25, -1.1, 0.3), 0.9, 1.1, 1.05 * i, b_.texture("crown", 0));
    b_.prism(desk_.moved(1.25, -1.1, 0), 0.16, 0.35, 10, b_.texture("mug", 2));
  }

  // What one sees who looks away from the desk.
  void other_walls() {
    constexpr double kQuarter = 3.14159265358979 / 2, kMiddle = (kFront + kBack) / 2;
    furnish(desk_.moved(-kSide, kMiddle, 0, kQuarter), (kFront - kBack) / 2 - 1);
    furnish(desk_.moved(0, kFront, 0, 2 * kQuarter), kSide - 0.3);
    furnish(desk_.moved(kSide, kMiddle, 0, -kQuarter), (kFront - kBack) / 2 - 1);
  }
  // From -half to half along a wall: shelves, a door now and then, posters.
  void furnish(const LocalFrame& wall, double half) {
    const int wood = b_.texture("wood", 1);
    for (double r = -half; r + 1.2 < half; r += random_.uniform(1.2, 1.6)) {
      const double what = random_.uniform();
      if (what < 0.2) {
        b_.wall(wall, r, r + 0.95, 0, 2.05, 0.03, b_.any_texture("door", 5), false);
        continue;
      }
      if (what < 0.75) {
        const double height = random_.uniform(0.7, 1.1);
        b_.box(wall, {r, r + 1.1, 0, 0.32, 0, height}, wood, wood, b_.any_texture("shelf", 4));
        books(wall.moved(r + 0.4, 0.16, height), 3);
      }
      const double z = random_.uniform(1.3, 1.5);
      b_.wall(wall, r + 0.2, r + 0.85, z, z + 0.9, 0.01, b_.any_texture("poster", 6), false);
    }
  }

  Site& site_;
  WorldBuilder& b_;
  Random& random_;
  Eigen::Vector3d centre_;
  LocalFrame desk_;
  double top_ = 0;
};

}  // namespace

void build_desk(Site& site) { DeskBuilder(site).build(); }

}  // namespace edgevo
