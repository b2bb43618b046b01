// SPDX-License-Identifier: BSD-3-Clause
#include "props.h"

#include <cmath>

namespace edgevo {

void add_tree(WorldBuilder& b, const LocalFrame& place, double height, const Leaves& leaves) {
  Random& r = b.random();
  const double trunk = 0.34 * height;
  const double radius = 0.022 * height + 0.05;
  const int bark = b.any_texture("bark", 4);
  b.prism(place, radius, trunk, 7, bark);
  // It gets thinner among the leaves.
  b.prism(place.moved(0, 0, trunk), 0.65 * radius, 0.1 * height, 6, bark);
  b.prism(place.moved(0, 0, trunk + 0.1 * height), 0.35 * radius, 0.18 * height, 5, bark);
  const double size = height - trunk + 0.6, turn = r.uniform(0, 1);
  for (int i = 0; i < 4; ++i) {  // crossing cards, some in front of the others
    const LocalFrame centre = place.moved(r.uniform(-0.12, 0.12) * size, r.uniform(-0.12, 0.12) * size,
                                          trunk - 0.6 + r.uniform(-0.1, 0.15) * size);
    b.card(centre, size * r.uniform(0.8, 1.05), size * r.uniform(0.85, 1), turn + 0.785 * i,
           b.any_texture("crown" + leaves.suffix(), 5), leaves.gain * float(r.uniform(0.9, 1.08)));
  }
}

void add_conifer(WorldBuilder& b, const LocalFrame& place, double height) {
  Random& r = b.random();
  const double turn = r.uniform(0, 1);
  const int texture = b.any_texture("conifer", 4);
  for (int i = 0; i < 3; ++i)
    b.card(place, 0.48 * height, height, turn + 1.0472 * i, texture, float(r.uniform(0.8, 1.1)));
}

void add_bush(WorldBuilder& b, const LocalFrame& place, double width, const Leaves& leaves) {
  Random& r = b.random();
  for (int i = 0; i < 2; ++i)
    b.card(place.moved(0, r.uniform(-0.2, 0.2), -0.05), width, width * r.uniform(0.5, 0.75),
           r.uniform(-0.5, 0.5) + 1.2 * i, b.any_texture("bush" + leaves.suffix(), 4),
           leaves.gain * float(r.uniform(0.8, 1.15)));
}

void add_car(WorldBuilder& b, const LocalFrame& place) {
  Random& r = b.random();
  const int look = r.below(8);
  const int side = b.texture("car_side", look), end = b.texture("car_end", look),
            glass = b.texture("car_glass", 0);
  const int paint = b.texture("metal", look);
  constexpr double kLength = 4.3, kHalf = 0.85, kTop = 1.5;
  // The outline of texture car_side (512 x 256 texels), metres from the front and from the ground.
  const auto at = [&](double x, double y) {
    return Eigen::Vector2d(x / 512 * kLength - kLength / 2, kTop * (1 - y / 256));
  };
  // One by one: the next surface moves those before it in memory.
  b.fit(place.point(-kLength / 2, kHalf, kTop), kLength * place.right, {0, 0, -kTop}, side).is_solid = true;
  Surface& right = b.fit(place.point(kLength / 2, -kHalf, kTop), -kLength * place.right, {0, 0, -kTop}, side);
  right.uv_origin = {1, 0}, right.uv_size = {-1, 1};  // mirrored: its front points the same way
  right.is_solid = true;
  const Eigen::Vector2d corners[] = {at(0, 205),  at(0, 118),  at(160, 100), at(212, 10),
                                     at(375, 10), at(440, 92), at(512, 98),  at(512, 205)};
  const int skins[] = {end, paint, glass, paint, glass, paint, end};
  for (int i = 0; i < 7; ++i) {  // strips across the car, from the front bumper over the roof to the rear one
    const Eigen::Vector2d &low = corners[i], &high = corners[i + 1];
    const bool is_rear = i >= 4;  // seen from behind
    const double edge = is_rear ? kHalf : -kHalf;
    const Eigen::Vector2d& top = is_rear ? low : high;
    const Eigen::Vector2d& bottom = is_rear ? high : low;
    const Eigen::Vector3d corner = place.point(top.x(), edge, top.y());
    b.fit(corner, -2 * edge * place.out, place.point(bottom.x(), edge, bottom.y()) - corner, skins[i]);
  }
}

void add_lamp(WorldBuilder& b, const LocalFrame& place) {
  const int metal = b.texture("metal", 20);
  b.build_as(Thing::kPole, [&] {
    b.prism(place, 0.07, 6, 6, metal, 0.6f);
    b.box(place, {-0.04, 0.04, 0, 1.6, 5.9, 6.0}, metal, metal, -1, false, 0.6f);
    b.box(place, {-0.12, 0.12, 1.0, 1.7, 5.78, 5.9}, metal, metal, -1, false, 1.1f);
  });
}

void add_sign(WorldBuilder& b, const LocalFrame& place) {
  b.prism(place, 0.035, 2.6, 5, b.texture("metal", 21), 0.8f);
  b.card(place.moved(0, 0.05, 2.0), 0.7, 0.7, 0, b.any_texture("sign", 6));
}

}  // namespace edgevo
