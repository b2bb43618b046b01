// SPDX-License-Identifier: BSD-3-Clause
// A motorway: lanes, crash barriers without a mark along them, a sign now and then, trees far off. Few edges
// are near, and most of these run along the motion.
#include <algorithm>

#include "props.h"
#include "street_plan.h"
#include "worlds.h"

namespace edgevo {
namespace {

constexpr double kLane = 3.75, kBarrier = 9.5;  // from the middle of the carriageway, metres
constexpr double kBeyond = 400;                 // length beyond the waypoints

class MotorwayBuilder {
 public:
  explicit MotorwayBuilder(Site& site)
      : b_(site.build),
        random_(b_.random()),
        roads_(streets_of(site.params.waypoints, 25, kBeyond, kBeyond)),
        density_(site.params.world.density) {}

  void build() {
    for (const Street& road : roads_) {
      ground(road);
      for (double sign : {1.0, -1.0}) {
        const Side side{&road, sign};
        marks(Side{&road, 1}, sign);
        barrier(side);
        signs(side);
        trees(side);
      }
    }
  }

 private:
  void ground(const Street& road) {
    constexpr double kPiece = 32, kGrass = 150;
    const Side left{&road, 1};
    for (double s = 0; s < road.length; s += kPiece) {
      strip(left, s, s + kPiece, -kBarrier, kBarrier, 0, "asphalt");
      strip(left, s, s + kPiece, kBarrier, kGrass, -0.02, "grass");
      strip(left, s, s + kPiece, -kGrass, -kBarrier, -0.02, "grass");
    }
  }

  // From d0 to d1 left of the middle.
  void strip(const Side& left, double s0, double s1, double d0, double d1, double z, const char* kind) {
    const LocalFrame p = left.place(s0, 0, z);  // right of it: along the road
    b_.tile(p.point(0, -d0, 0), -(d1 - d0) * p.out, (s1 - s0) * p.right, b_.texture(kind, 0)).is_two_sided =
        true;
  }

  void marks(const Side& left, double sign) {
    constexpr double kDash = 6, kPeriod = 18, kHalf = 0.08;
    const double length = left.street->length, lane = sign * kLane / 2, rim = sign * 1.5 * kLane;
    for (double s = 2; s + kDash < length; s += kPeriod)
      strip(left, s, s + kDash, lane - kHalf, lane + kHalf, 0.004, "paint");
    strip(left, 0, length, rim - kHalf, rim + kHalf, 0.004, "paint");
  }

  void barrier(const Side& side) {
    const double length = side.street->length;
    const LocalFrame p = side.left_end(0, length, kBarrier, 0);
    const int rail = b_.texture("stripes", 0);
    b_.build_as(Thing::kRail, [&] {
      b_.box(p, {0, length, -0.06, 0.06, 0.45, 0.78}, rail, rail, -1, true, 0.9f);
    });
  }

  void signs(const Side& side) {
    for (double s = 20; s < side.street->length; s += random_.uniform(60, 140))
      add_sign(b_, side.place(s, kBarrier + 1.5, 0).moved(0, 0, 0, side.sign * 1.3));
  }

  void trees(const Side& side) {
    for (double s = 5; s < side.street->length; s += random_.uniform(4, 14) / std::max(0.05, density_))
      add_tree(b_, side.place(s, random_.uniform(35, 120), 0), random_.uniform(6, 14));
  }

  WorldBuilder& b_;
  Random& random_;
  std::vector<Street> roads_;
  double density_;
};

}  // namespace

void build_motorway(Site& site) { MotorwayBuilder(site).build(); }

}  // namespace edgevo
