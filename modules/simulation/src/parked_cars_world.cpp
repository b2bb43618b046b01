// SPDX-License-Identifier: BSD-3-Clause
// A row of parked cars, and behind it, across a lawn or a square, a row of houses: objects at two depths,
// seen by a camera that looks sideways.
#include <algorithm>
#include <cmath>

#include "props.h"
#include "street_plan.h"
#include "worlds.h"

namespace edgevo {
namespace {

constexpr double kCarHalf = 0.85, kCarLength = 4.3;  // metres, of add_car()
constexpr double kEnds = 60;                         // length of the rows beyond the drive, metres

class ParkedCarsBuilder {
 public:
  explicit ParkedCarsBuilder(Site& site)
      : site_(site),
        b_(site.build),
        random_(b_.random()),
        density_(site.params.world.density),
        row_(straight(site.params.waypoints)),
        side_{&row_, site.params.motion.look_right_deg > 0 ? -1.0 : 1.0} {
    cars_ = random_.uniform(3, 5);
    houses_ = random_.uniform(15, 30);
  }

  void build() {
    ground();
    cars();
    street_furniture();
    houses();
    trees_behind();
  }

 private:
  // From the first to the last waypoint, and kEnds beyond.
  static Street straight(const std::vector<Eigen::Vector3d>& waypoints) {
    return streets_of({waypoints.front(), waypoints.back()}, kEnds, kEnds, kEnds).front();
  }

  // Road on this side of the cars, the parking strip, a pavement, then a lawn or a square up to the houses.
  void ground() {
    constexpr double kBehind = 90;
    const double kerb = cars_ + 2 * kCarHalf + 0.4, walk = kerb + random_.uniform(1.2, 2.5);
    const char* middle[] = {"meadow", "grass", "slabs", "gravel", "worn_asphalt"};
    strip(-20, kerb, 0, random_.uniform() < 0.5 ? "asphalt" : "worn_asphalt");
    strip(kerb, walk, 0.1, "slabs");
    strip(walk, houses_ + kBehind, 0.09, middle[random_.below(5)]);
    const LocalFrame p = side_.left_end(0, row_.length, kerb);
    const int stone = b_.texture("concrete", 0);
    b_.build_as(Thing::kKerb, [&] {
      b_.box(p, {0, row_.length, -0.15, 0.01, 0, 0.12}, stone, stone, -1, true, 1.1f);
    });
    pavement_ = {kerb, walk};
  }
  // Between d0 and d1 from the row, in pieces, whose textures repeat.
  void strip(double d0, double d1, double z, const char* kind) {
    const LocalFrame p = side_.left_end(0, row_.length, d1, z);
    b_.tile(p.point(0, 0, 0), row_.length * p.right, (d1 - d0) * p.out, b_.texture(kind, 0));
  }

  void cars() {
    const double spacing = random_.uniform(4.9, 7.5), loose = random_.uniform(0.05, 0.5);
    const double taken = std::min(0.95, 0.55 + 0.35 * density_);
    for (double s = 1; s + kCarLength < row_.length; s += spacing + random_.uniform(0, loose)) {
      if (random_.uniform() > taken) continue;
      const double turn = random_.uniform(-0.04, 0.04) + (random_.uniform() < 0.2 ? 3.14159 : 0);
      const double d = cars_ + kCarHalf + random_.uniform(-0.1, 0.25);
      add_car(b_, side_.place(s + kCarLength / 2, d).moved(0, 0, 0, turn));
    }
  }

  void street_furniture() {
    for (double s = 2; s < row_.length; s += random_.uniform(6, 22) / density_) {
      const LocalFrame p = side_.place(s, pavement_.x() + 0.4, 0.1);
      const double what = random_.uniform();
      if (what < 0.35)
        add_lamp(b_, p);
      else if (what < 0.6)
        add_sign(b_, p);
      else if (what < 0.8)
        add_tree(b_, p, random_.uniform(4.5, 8));
      else
        bollard(p);
    }
  }
  void bollard(const LocalFrame& p) {
    b_.prism(p, 0.09, random_.uniform(0.6, 1.1), 8, b_.any_texture("mug", 3), 0.7f);
  }

  void houses() {
    const double gaps = random_.uniform(0, 5);
    for (double s = 0; s < row_.length;) {
      const double width = random_.uniform(7, 15), set_back = random_.uniform(0, 3);
      const std::string& wall = site_.walls[size_t(random_.below(int(site_.walls.size())))];
      add_house(b_, side_.left_end(s, width, houses_ + set_back, 0.08), width, 9, 1 + random_.below(4), wall);
      if (random_.uniform() < 0.4 * density_)
        add_bush(b_, side_.place(s + width / 2, houses_ - random_.uniform(0.8, 2), 0.08),
                 random_.uniform(1, 2.2));
      s += width + (random_.uniform() < 0.5 ? random_.uniform(0, gaps) : 0);
    }
  }

  void trees_behind() {
    for (double s = 0; s < row_.length; s += random_.uniform(3, 9) / density_)
      add_tree(b_, side_.place(s, houses_ + random_.uniform(15, 45), 0), random_.uniform(8, 15));
  }

  Site& site_;
  WorldBuilder& b_;
  Random& random_;
  double density_;
  Street row_;
  Side side_;
  /// Distances from the drive to the near sides of the cars and of the houses, metres.
  double cars_ = 0, houses_ = 0;
  /// Both rims of the pavement.
  Eigen::Vector2d pavement_ = {0, 0};
};

}  // namespace

void build_parked_cars(Site& site) { ParkedCarsBuilder(site).build(); }

}  // namespace edgevo
