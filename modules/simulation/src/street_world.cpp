// SPDX-License-Identifier: BSD-3-Clause
// A street with turns. Each leg between waypoints is a street that continues beyond its ends; where two cross
// there is a junction.
#include <algorithm>
#include <cmath>

#include "edgevo/core/error.h"
#include "mirror.h"
#include "props.h"
#include "street_plan.h"
#include "worlds.h"

namespace edgevo {
namespace {

constexpr double kRoad = 5.0;         // half the road, kerb to middle, metres
constexpr double kWalk = 7.3;         // outer rim of the pavement
constexpr double kKerb = 0.13;        // height of the kerb
constexpr double kStreetBeyond = 65;  // length of a street beyond its waypoints

class StreetBuilder {
 public:
  // Beyond their legs streets go on for `beyond` metres; 0: nothing lies beyond the end of a leg.
  StreetBuilder(Site& site, const std::vector<Leg>& legs, double beyond)
      : site_(site),
        b_(site.build),
        random_(b_.random()),
        is_cut_(beyond == 0),
        streets_(streets_of(legs, 25, kStreetBeyond, beyond)) {}

  void build() {
    ground();
    for (const Street& street : streets_) {
      lane_marks(street);
      for (double sign : {1.0, -1.0}) {
        const Side side{&street, sign};
        pavement(side);
        houses(side);
        furniture(side);
        parked_cars(side);
      }
      closing(street, -1);
      if (!is_cut_) closing(street, street.length + 1);
    }
  }

 private:
  double density() const { return site_.params.world.density; }

  double room(const Street& own, const Eigen::Vector2d& p) const { return edgevo::room(streets_, own, p); }
  // True if no other street is within `reach` of the strip s0..s1, d0..d1.
  bool is_free(const Side& side, double s0, double s1, double d0, double d1, double reach) const {
    for (double s = s0; s <= s1 + 0.01; s += (s1 - s0) / 4)
      for (double d = d0; d <= d1 + 0.01; d += std::max(0.5, (d1 - d0) / 4))
        if (room(*side.street, side.at(s, d)) < reach) return false;
    return true;
  }

  void ground() {
    Eigen::Vector2d low(1e9, 1e9), high(-1e9, -1e9);
    for (const Street& s : streets_)
      for (const Eigen::Vector2d& p : {s.start, Eigen::Vector2d(s.start + s.length * s.along)})
        low = low.cwiseMin(p), high = high.cwiseMax(p);
    constexpr double kTile = 32;
    const int asphalt = b_.texture("asphalt", 0);
    for (double x = low.x() - kTile; x < high.x() + kTile; x += kTile)
      for (double y = low.y() - kTile; y < high.y() + kTile; y += kTile)
        if (near_a_street({x + kTile / 2, y + kTile / 2}, 40)) {
          Surface& s = b_.tile({x, y + kTile, 0}, {kTile, 0, 0}, {0, -kTile, 0}, asphalt);
          s.uv_origin = {0, 0};  // continues seamlessly: a tile is four repeats
        }
  }
  bool near_a_street(const Eigen::Vector2d& p, double reach) const {
    return std::any_of(streets_.begin(), streets_.end(),
                       [&](const Street& s) { return s.distance(p) < reach; });
  }

  void lane_marks(const Street& street) {
    const int paint = b_.texture("paint", 0);
    const Side left{&street, 1};
    for (double s = 2; s + 3 < street.length; s += 7.5) {
      if (room(street, left.at(s, 0)) < kRoad + 2 || room(street, left.at(s + 3, 0)) < kRoad + 2) continue;
      mark(left, s, s + 3, -0.07, 0.07, paint);
    }
    const int manhole = b_.texture("manhole", 0);
    for (double s = 9; s < street.length; s += random_.uniform(14, 32)) {
      const LocalFrame p = left.place(s, random_.uniform(-2.5, 2.5), 0.004);
      b_.fit(p.point(-0.33, 0.33, 0), 0.66 * p.right, -0.66 * p.out, manhole).is_two_sided = true;
    }
    for (double s = 4; s < street.length; s += 1) stop_line(left, s, paint);
  }
  // Bars across the road where a junction begins.
  void stop_line(const Side& left, double s, int paint) {
    const double here = room(*left.street, left.at(s, 0)), next = room(*left.street, left.at(s + 1, 0));
    if ((here < kRoad + 1.5) == (next < kRoad + 1.5)) return;
    for (double d = -kRoad + 0.4; d + 0.5 < kRoad; d += 1.0) mark(left, s - 1, s + 1.4, d, d + 0.5, paint);
  }
  void mark(const Side& side, double s0, double s1, double d0, double d1, int paint) {
    const LocalFrame p = side.place(s0, 0, 0.004);  // right of it: along the street
    b_.tile(p.point(0, -d0, 0), -(d1 - d0) * p.out, (s1 - s0) * p.right, paint).is_two_sided = true;
  }

  // Pavement and kerb, cut where another street comes in.
  void pavement(const Side& side) {
    const double step = 0.5;
    double begin = -1;
    for (double s = 0; s <= side.street->length + step; s += step) {
      const bool open = s <= side.street->length && room(*side.street, side.at(s, kRoad + 0.5)) > kRoad + 0.9;
      if (open && begin < 0) begin = s;
      if (begin >= 0 && (!open || s - begin > 24)) {
        pavement_piece(side, begin, s);
        begin = open ? s : -1;
      }
    }
  }
  void pavement_piece(const Side& side, double s0, double s1) {
    const LocalFrame p = side.left_end(s0, s1 - s0, kRoad, 0);
    const double w = s1 - s0;
    const int stone = b_.texture("concrete", 0), slabs = b_.texture("slabs", 0);
    b_.build_as(Thing::kKerb, [&] { b_.box(p, {0, w, -0.16, 0, 0, kKerb}, stone, stone, -1, true, 1.2f); });
    b_.tile(p.point(0, -(kWalk - kRoad), kKerb - 0.005), w * p.right, (kWalk - kRoad - 0.16) * p.out, slabs);
    b_.tile(p.point(0, -26, kKerb - 0.02), w * p.right, (26 - (kWalk - kRoad)) * p.out,
            b_.texture("grass", 0))
        .gain *= 0.9f;
    b_.build_as(Thing::kKerb, [&] {  // gutter
      b_.box(p, {0, w, 0, 0.3, 0, 0.006}, stone, stone, -1, true, 0.7f);
    });
  }

  void houses(const Side& side) {
    for (double s = 0.5; s < side.street->length;) {
      const double width = random_.uniform(6.5, 13),
                   setback = random_.uniform() < 0.45 ? 0.0 : random_.uniform(1.5, 4.5);
      const double depth = random_.uniform(7, 10), d = kWalk + setback;
      if (is_cut_ && s + width > side.street->length) break;
      if (!is_free(side, s, s + width, d - 0.5, d + depth, kWalk + 0.5)) {
        s += 1.5;
        continue;
      }
      const LocalFrame place = side.left_end(s, width, d, kKerb - 0.02);
      const std::string& wall = site_.walls[size_t(random_.below(int(site_.walls.size())))];
      add_house(b_, place, width, depth, 2 + (random_.uniform() < 0.45) + (random_.uniform() < 0.15), wall);
      if (setback > 0) front_garden(place, width, setback);
      s += width + (random_.uniform() < 0.5 ? 0.0 : random_.uniform(1, 5));
    }
  }
  void front_garden(const LocalFrame& place, double width, double setback) {
    const double o = setback - 0.1, gate = random_.uniform(0.2, 0.7) * width,
                 height = random_.uniform(0.7, 1.5);
    const int skin = random_.uniform() < 0.5
                         ? b_.any_texture("hedge", 2)
                         : b_.any_texture(site_.walls[size_t(random_.below(int(site_.walls.size())))], 3);
    b_.box(place, {0, gate, o - 0.4, o, 0, height}, skin, skin);
    b_.box(place, {gate + 1.4, width, o - 0.4, o, 0, height}, skin, skin);
    for (double r = 0.8; r < width; r += random_.uniform(1.5, 4))
      if (random_.uniform() < density() * 0.5)
        add_bush(b_, place.moved(r, setback * random_.uniform(0.3, 0.7), 0), random_.uniform(0.8, 1.8));
    if (setback > 3 && random_.uniform() < 0.5 * density())
      add_tree(b_, place.moved(random_.uniform(1, width - 1), 0.5 * setback, 0), random_.uniform(4, 6.5));
  }

  void furniture(const Side& side) {
    double next = 3;
    for (double s = 3; s < side.street->length; s += 1) {
      if (s < next || !is_free(side, s - 0.5, s + 0.5, kRoad, kWalk, kRoad + 3)) continue;
      const LocalFrame place = side.place(s, kRoad + 0.65, kKerb);
      const double what = random_.uniform();
      if (what < 0.5)
        add_tree(b_, place, random_.uniform(5.5, 9));
      else if (what < 0.75)
        add_lamp(b_, place);
      else
        add_sign(b_, place.moved(0, 0, 0, side.sign * 1.3));
      next = s + random_.uniform(6, 15) / std::max(0.05, density());
    }
  }

  void parked_cars(const Side& side) {
    for (double s = 4; s + 5 < side.street->length; s += 5.4) {
      if (random_.uniform() > 0.55 * density()) continue;
      if (!is_free(side, s - 2.5, s + 2.5, kRoad - 2, kRoad, kRoad + 6)) continue;
      const LocalFrame place =
          side.place(s + random_.uniform(-0.3, 0.3), kRoad - 1.05 + random_.uniform(-0.1, 0.05));
      add_car(b_, random_.uniform() < 0.85 ? place : place.moved(0, 0, 0, 3.14159265358979));
    }
  }

  // View at the far end of a street.
  void closing(const Street& street, double s) {
    const Side left{&street, 1};
    const Eigen::Vector2d p = left.at(s, 0), inwards = (s < 0 ? 1 : -1) * street.along;
    if (room(street, p) < kWalk + 14) return;
    const LocalFrame place = facing({p.x(), p.y(), 0}, std::atan2(inwards.y(), inwards.x()));
    add_house(b_, place.moved(-13, 0, 0), 13, 8, 3, site_.walls.front());
    add_house(b_, place.moved(0, 0, 0), 13, 8, 2, site_.walls.back());
    for (double r = -11; r < 12; r += random_.uniform(3, 5))
      add_tree(b_, place.moved(r, 2.5, 0), random_.uniform(5, 9));
  }

  Site& site_;
  WorldBuilder& b_;
  Random& random_;
  const bool is_cut_;
  std::vector<Street> streets_;
};

}  // namespace

void build_street(Site& site) { StreetBuilder(site, street_legs(site.params), kStreetBeyond).build(); }

void build_mirrored_street(Site& site) {
  const std::vector<Leg> legs = street_legs(site.params);
  if (legs.size() != 1)
    throw InputError(site.params.where.waypoints, "a mirrored street has no turns", "give two waypoints");
  const Leg half{legs[0].from, 0.5 * (legs[0].from + legs[0].to)};
  StreetBuilder(site, {half}, 0).build();
  add_mirror_image({half.to, (half.to - half.from).normalized()}, &site.build.surfaces());
}

}  // namespace edgevo
