// SPDX-License-Identifier: BSD-3-Clause
// A corridor with turns. Most edges run along it; one bare section has no others, so that motion along it is
// barely observable.
#include <algorithm>
#include <cmath>

#include "street_plan.h"
#include "worlds.h"

namespace edgevo {
namespace {

constexpr double kHalf = 1.25, kHeight = 2.7;       // metres
constexpr double kBareFrom = 0.42, kBareTo = 0.68;  // the bare section, shares of the first leg

class CorridorBuilder {
 public:
  explicit CorridorBuilder(Site& site)
      : site_(site),
        b_(site.build),
        random_(b_.random()),
        corridors_(streets_of(street_legs(site.params), 2, kHalf, 0)),
        wall_(b_.texture(site.walls.front(), 0)),
        paint_(b_.texture("stripes", 1)) {
    for (size_t i = 0; i < corridors_.size(); ++i)
      corridors_[i].length += i + 1 < corridors_.size() ? kHalf : 6;
  }

  void build() {
    for (const Street& corridor : corridors_) {
      for (double sign : {1.0, -1.0}) side_wall({&corridor, sign});
      end_wall(corridor, corridor.length, 1);
      if (&corridor == &corridors_.front()) end_wall(corridor, 0, -1);
    }
    for (const Street& corridor : corridors_) floor_and_ceiling(corridor);
    end_wall_at_corners();
  }

 private:
  bool is_bare(const Street& corridor, double s) const {
    return &corridor == &corridors_.front() && s > kBareFrom * corridor.length &&
           s < kBareTo * corridor.length;
  }
  bool is_wall(const Side& side, double s) const {
    return room(corridors_, *side.street, side.at(s, kHalf)) > kHalf - 0.01;
  }

  void side_wall(const Side& side) {
    constexpr double kStep = 0.25;
    double begin = -1;
    for (double s = 0; s <= side.street->length + kStep / 2; s += kStep) {
      const bool goes_on =
          s < side.street->length && is_wall(side, s + kStep / 2) &&
          (begin < 0 || is_bare(*side.street, begin + 0.01) == is_bare(*side.street, s + 0.01));
      if (begin >= 0 && !goes_on) {
        wall_piece(side, begin, s);
        begin = s < side.street->length && is_wall(side, s + kStep / 2) ? s : -1;
      } else if (begin < 0 && goes_on) {
        begin = s;
      }
    }
  }

  void wall_piece(const Side& side, double s0, double s1) {
    const double w = s1 - s0;
    const LocalFrame p = side.left_end(s0, w, kHalf);
    const bool bare = is_bare(*side.street, s0 + 0.01);
    const int metal = b_.texture("metal", 1), rail = b_.texture("stripes", 0);
    b_.wall(p, 0, w, 0, kHeight, 0, bare ? paint_ : wall_, true);
    b_.build_as(Thing::kRail, [&] {
      b_.box(p, {0, w, 0, 0.02, 0, 0.12}, rail, rail, -1, true, 0.45f);                      // skirting
      b_.box(p, {0, w, 0, 0.05, 0.92, 1.02}, rail, rail, -1, true, 0.6f);                    // hand rail
      if (side.sign > 0) b_.box(p, {0, w, 0, 0.12, 2.3, 2.38}, rail, rail, -1, true, 1.1f);  // pipe
      b_.box(p, {0, w, 0, 0.07, 2.5, 2.55}, rail, rail, -1, true, 0.7f);
    });
    if (!bare) furnish(p, w, metal);
  }

  void furnish(const LocalFrame& p, double w, int metal) {
    for (double r = random_.uniform(0.3, 1); r + 1.2 < w; r += random_.uniform(0.7, 1.8)) {
      const double what = random_.uniform();
      if (what < 0.4) {
        b_.wall(p, r, r + 1.0, 0, 2.1, 0.06, b_.any_texture("door", 5), false);
        r += 1.1;
      } else if (what < 0.75) {
        b_.wall(p, r, r + 0.55, 1.15, 2.05, 0.015, b_.any_texture("poster", 6), false);
        r += 0.6;
      } else if (what < 0.85) {
        b_.box(p, {r, r + 0.35, 0, 0.2, 1.2, 1.8}, metal, metal, b_.any_texture("box", 2), false);
        r += 0.4;
      } else {
        b_.box(p, {r, r + 0.9, 0, 0.35, 0, 0.85}, metal, metal, b_.any_texture("shelf", 2));
        r += 1.0;
      }
    }
  }

  void floor_and_ceiling(const Street& corridor) {
    const int tiles = b_.texture("floor_tiles", 0), along = b_.texture("stripes", 2),
              white = b_.texture("stripes", 3);
    const Side left{&corridor, 1};
    // Where two corridors overlap, the later one lies on top.
    const double lift = 0.001 * double(&corridor - corridors_.data());
    const double cuts[] = {0, kBareFrom * corridor.length, kBareTo * corridor.length, corridor.length};
    for (int i = 0; i < 3; ++i) {
      const double w = cuts[i + 1] - cuts[i];
      const LocalFrame p = left.left_end(cuts[i], w, kHalf, lift);
      b_.tile(p.point(0, 0, 0), w * p.right, 2 * kHalf * p.out,
              is_bare(corridor, cuts[i] + 0.1) ? along : tiles);
      b_.tile(p.point(0, 2 * kHalf, kHeight - 2 * lift), w * p.right, -2 * kHalf * p.out, white).gain = 1.15f;
    }
    const int lamp = b_.texture("metal", 9);
    for (double s = 1; s + 1.2 < corridor.length; s += 2.6) {
      if (is_bare(corridor, s) || is_bare(corridor, s + 1.2)) continue;
      const LocalFrame p = left.left_end(s, 1.2, 0);
      b_.tile(p.point(0, 0.15, kHeight - 0.01), 1.2 * p.right, -0.3 * p.out, lamp).gain = 1.6f;
    }
  }

  // Closes a corridor; `direction` is +1 at its far end.
  void end_wall(const Street& corridor, double s, double direction) {
    const Side left{&corridor, 1};
    const Eigen::Vector2d p = left.at(s, 0), back = -direction * corridor.along;
    const LocalFrame place = facing({p.x(), p.y(), 0}, std::atan2(back.y(), back.x()));
    for (double r = -kHalf; r < kHalf - 0.01; r += kHalf / 4) {  // open where another corridor goes through
      const Eigen::Vector3d at = place.point(r + kHalf / 8, -0.1, 0);
      if (room(corridors_, corridor, at.head<2>()) > kHalf)
        b_.wall(place, r, r + kHalf / 4, 0, kHeight, 0, wall_, true);
    }
    if (room(corridors_, corridor, p) < 2 * kHalf + 0.1 && direction > 0)
      b_.wall(place, -0.35, 0.35, 0.9, 2.2, 0.01, b_.any_texture("poster", 6), false);
    else
      b_.wall(place, -0.55, 0.55, 0, 2.1, 0.03, b_.any_texture("door", 5), false);
  }

  // The near end of every later corridor, behind the corner.
  void end_wall_at_corners() {
    for (size_t i = 1; i < corridors_.size(); ++i) end_wall(corridors_[i], 0, -1);
  }

  Site& site_;
  WorldBuilder& b_;
  Random& random_;
  std::vector<Street> corridors_;
  int wall_, paint_;
};

}  // namespace

void build_corridor(Site& site) { CorridorBuilder(site).build(); }

}  // namespace edgevo
