// SPDX-License-Identifier: BSD-3-Clause
// A corridor of bays that are copies of one another, to the texel: after each bay all looks as it did before,
// but for the end of the corridor far ahead.
#include <cmath>

#include "edgevo/core/error.h"
#include "street_plan.h"
#include "worlds.h"

namespace edgevo {
namespace {

constexpr double kHalf = 1.25, kHeight = 2.7;  // metres
constexpr double kBay = 3;                     // length of a bay, metres
constexpr int kBefore = 2;                     // bays before the first waypoint
constexpr double kBeyond = 75;  // metres beyond the last one: there the end is a few pixels wide

class BayBuilder {
 public:
  BayBuilder(Site& site, const Street& corridor)
      : b_(site.build), corridor_(corridor), wall_(b_.texture(site.walls.front(), 0)) {}

  void build() {
    for (double sign : {1.0, -1.0}) side_wall({&corridor_, sign});
    floor_and_ceiling();
    repeat(int(corridor_.length / kBay));
    end_wall(0, 1);
    end_wall(std::floor(corridor_.length / kBay) * kBay, -1);
  }

 private:
  void side_wall(const Side& side) {
    const LocalFrame p = side.left_end(0, kBay, kHalf);
    const int variant = side.sign > 0 ? 0 : 1;
    const int rail = b_.texture("stripes", 0), metal = b_.texture("metal", 1);
    b_.wall(p, 0, kBay, 0, kHeight, 0, wall_, true);
    b_.build_as(Thing::kRail, [&] {  // skirting
      b_.box(p, {0, kBay, 0, 0.02, 0, 0.12}, rail, rail, -1, true, 0.45f);
    });
    b_.box(p, {0.85, 2.05, 0, 0.05, 0, 2.2}, metal, metal, b_.texture("door", variant), false, 0.9f);
    b_.wall(p, 2.2, 2.42, 1.5, 1.65, 0.01, b_.texture("sign", variant),
            false);  // number of the room: the same
    b_.wall(p, 0.15, 0.7, 1.15, 2.0, 0.015, b_.texture("poster", variant), false);
    b_.box(p, {-0.1, 0.1, 0, 0.12, 0, kHeight}, metal, metal, -1, true, 0.8f);  // pilaster between two bays
    if (side.sign > 0)
      b_.build_as(Thing::kRail, [&] {  // pipe
        b_.box(p, {0, kBay, 0, 0.12, 2.4, 2.48}, rail, rail, -1, true, 1.1f);
      });
  }

  void floor_and_ceiling() {
    const LocalFrame p = Side{&corridor_, 1}.left_end(0, kBay, kHalf);
    b_.tile(p.point(0, 0, 0), kBay * p.right, 2 * kHalf * p.out, b_.texture("floor_tiles", 0));
    b_.tile(p.point(0, 2 * kHalf, kHeight), kBay * p.right, -2 * kHalf * p.out, b_.texture("stripes", 3))
        .gain = 1.15f;
    b_.tile(p.point(0.9, kHalf + 0.15, kHeight - 0.01), 1.2 * p.right, -0.3 * p.out, b_.texture("metal", 9))
        .gain = 1.6f;
  }

  // Copies what there is, one bay further each time.
  void repeat(int bays) {
    std::vector<Surface>& all = b_.surfaces();
    const size_t count = all.size();
    all.reserve(count * size_t(bays) + 2);
    for (int bay = 1; bay < bays; ++bay)
      for (size_t i = 0; i < count; ++i) {
        all.push_back(all[i]);
        all.back().origin.head<2>() += bay * kBay * corridor_.along;
      }
  }

  // `direction`: +1 if it looks along the corridor.
  void end_wall(double s, double direction) {
    const Eigen::Vector2d p = corridor_.start + s * corridor_.along, front = direction * corridor_.along;
    b_.wall(facing({p.x(), p.y(), 0}, std::atan2(front.y(), front.x())), -kHalf, kHalf, 0, kHeight, 0, wall_,
            true);
  }

  WorldBuilder& b_;
  const Street& corridor_;
  const int wall_;
};

}  // namespace

void build_identical_doors(Site& site) {
  const std::vector<Street> corridors =
      streets_of(street_legs(site.params), kBefore * kBay, kBefore * kBay, kBeyond);
  if (corridors.size() != 1)
    throw InputError(site.params.where.waypoints, "a corridor of identical doors has no turns",
                     "give two waypoints");
  BayBuilder(site, corridors.front()).build();
}

}  // namespace edgevo
