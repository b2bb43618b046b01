// SPDX-License-Identifier: BSD-3-Clause
// Rooms with tiles and panels on floor, walls and ceiling, as in a hospital: most edges are joints, many of
// them alike. Furniture stands along the walls.
#include <algorithm>
#include <cmath>

#include "room_plan.h"
#include "street_plan.h"
#include "worlds.h"

namespace edgevo {
namespace {

// Look of one room.
struct RoomStyle {
  int lower = 0, upper = 0, floor = 0, ceiling = 0, trim = 0;
  /// Height up to which the wall shows `lower`, metres.
  double dado = 1;
  float wall_gain = 1, floor_gain = 1, ceiling_gain = 1;
  bool has_rail = false, has_ceiling_lamps = false;
};

class RoomsBuilder {
 public:
  explicit RoomsBuilder(Site& site)
      : b_(site.build),
        random_(b_.random()),
        density_(site.params.world.density),
        plan_(plan_rooms(site.params, site.seed, site.params.where.waypoints)),
        path_(streets_of(plan_.waypoints, 0, 0, 0)),
        metal_(b_.any_texture("metal", 6)) {}

  void build() {
    for (size_t i = 0; i < plan_.rooms.size(); ++i) {
      const RoomStyle style = i > 0 && random_.uniform() < 0.4 ? last_ : any_style();
      room(plan_.rooms[i], style);
      if (i + 1 < plan_.rooms.size()) door_frame(plan_.rooms[i], plan_.rooms[i].doorways.back());
      if (i + 1 < plan_.rooms.size() && random_.uniform() < 0.7) door_leaf(plan_.rooms[i + 1]);
      last_ = style;
    }
  }

 private:
  RoomStyle any_style() {
    RoomStyle s;
    s.lower = b_.any_texture(random_.uniform() < 0.65 ? "white_tiles" : "wall_panels", 4);
    const double above = random_.uniform();
    s.upper = above < 0.35 ? s.lower
                           : b_.any_texture(above < 0.6    ? "wall_panels"
                                            : above < 0.75 ? "white_tiles"
                                                           : "painted_wall",
                                            4);
    s.floor = b_.any_texture(random_.uniform() < 0.8 ? "floor_slabs" : "white_tiles", 4);
    s.ceiling = b_.any_texture(random_.uniform() < 0.7 ? "ceiling_panels" : "painted_wall", 3);
    s.trim = b_.any_texture(random_.uniform() < 0.6 ? "metal" : "wood", 5);
    s.dado = random_.uniform(0.8, 1.6);
    s.wall_gain = float(random_.uniform(0.85, 1.2));
    s.floor_gain = float(random_.uniform(0.7, 1.05));
    s.ceiling_gain = float(random_.uniform(1.1, 1.6));
    s.has_rail = random_.uniform() < 0.6;
    s.has_ceiling_lamps = random_.uniform() < 0.85;
    return s;
  }

  void room(const Room& r, const RoomStyle& style) {
    floor_and_ceiling(r, style);
    for (int side = 0; side < 4; ++side) {
      double from = 0;  // along the wall; a wall has one doorway at most
      for (const Doorway& d : r.doorways) {
        if (d.side != side) continue;
        const double left = r.left_end(d);
        wall_piece(r, side, {from, left, 0, r.height}, style);
        wall_piece(r, side, {left, left + d.width, d.height, r.height}, style);
        from = left + d.width;
      }
      wall_piece(r, side, {from, r.length(side), 0, r.height}, style);
    }
    free_standing(r);
  }

  struct Piece {
    double r0, r1, z0, z1;
  };

  // Joints run on from one piece of a wall to the next.
  void panel(const LocalFrame& place, const Piece& p, double height, int texture, float gain) {
    constexpr double kRepeat = 3.2;  // metres, of the textures used here
    if (p.z1 - p.z0 < 0.01 || p.r1 - p.r0 < 0.01) return;
    Surface& s = b_.wall(place, p.r0, p.r1, p.z0, p.z1, 0, texture, true);
    s.uv_origin = {p.r0 / kRepeat, (height - p.z1) / kRepeat};
    s.gain *= gain;
  }

  void wall_piece(const Room& r, int side, const Piece& p, const RoomStyle& style) {
    const LocalFrame place = r.wall(side);
    const double dado = std::clamp(style.dado, p.z0, p.z1);
    panel(place, {p.r0, p.r1, dado, p.z1}, r.height, style.upper, style.wall_gain);
    panel(place, {p.r0, p.r1, p.z0, dado}, r.height, style.lower, style.wall_gain);
    if (p.z0 > 0 || p.r1 - p.r0 < 0.05) return;
    const int t = style.trim;
    b_.build_as(Thing::kRail, [&] {
      b_.box(place, {p.r0, p.r1, 0, 0.015, 0, 0.1}, t, t, -1, true, 0.7f);  // skirting
      if (style.has_rail) b_.box(place, {p.r0, p.r1, 0, 0.04, style.dado - 0.06, style.dado + 0.06}, t, t);
    });
    along_wall(place, p.r0 + 0.2, p.r1 - 0.2, style.dado);
  }

  void floor_and_ceiling(const Room& r, const RoomStyle& style) {
    const Eigen::Vector3d east(r.x1 - r.x0, 0, 0), north(0, r.y1 - r.y0, 0);
    b_.tile({r.x0, r.y1, 0}, east, -north, style.floor).gain *= style.floor_gain;
    b_.tile({r.x0, r.y0, r.height}, east, north, style.ceiling).gain *= style.ceiling_gain;
    if (!style.has_ceiling_lamps) return;
    const double step = random_.uniform(1.8, 3.2), length = random_.uniform(0.6, 1.3);
    const int lamp = b_.any_texture("metal", 9);
    for (double x = r.x0 + step / 2; x + length / 2 < r.x1; x += step)
      for (double y = r.y0 + step / 2; y + 0.3 < r.y1; y += step)
        b_.fit({x - length / 2, y - 0.15, r.height - 0.01}, {length, 0, 0}, {0, 0.3, 0}, lamp).gain = 1.9f;
  }

  // Jambs and lintel fill the thickness of the wall and stand out on both sides.
  void door_frame(const Room& r, const Doorway& d) {
    const LocalFrame place = r.wall(d.side).moved(r.left_end(d), 0, 0);
    const double wide = random_.uniform(0.05, 0.12), out = 0.02, back = -plan_.wall_m - 0.02;
    const int frame = b_.any_texture(random_.uniform() < 0.6 ? "metal" : "wood", 6);
    const float gain = float(random_.uniform(0.5, 1.2));
    b_.box(place, {-wide, 0, back, out, 0, d.height + wide}, frame, frame, -1, true, gain);
    b_.box(place, {d.width, d.width + wide, back, out, 0, d.height + wide}, frame, frame, -1, true, gain);
    b_.box(place, {0, d.width, back, out, d.height, d.height + wide}, frame, frame, -1, true, gain);
    const Eigen::Vector3d across = d.width * place.right, through = (out - back) * place.out;
    b_.tile(place.point(0, out, d.height), across, -through, frame).gain *= gain;  // under the lintel
    b_.tile(place.point(0, -plan_.wall_m, 0), across, plan_.wall_m * place.out, frame).gain *=
        0.5f;  // threshold
  }

  // A plain door, open into the room that the walk comes into.
  void door_leaf(const Room& r) {
    constexpr double kThick = 0.045, kHandle = 1.05;  // metres
    const Doorway& d = r.doorways.front();
    const double width = std::min(d.width, 1.15), hinge = random_.uniform() < 0.5 ? 0 : d.width;
    const double open = random_.uniform(1.6, 2.8);  // radians; pi: back against the wall
    const LocalFrame place =
        r.wall(d.side).moved(r.left_end(d) + hinge, 0.03, 0, hinge > 0 ? open - M_PI : -open);
    for (double along : {0.5, 1.0})
      if (distance_to_walk(place.point(along * width, 0, 0)) < 0.3) return;
    const int skin = b_.any_texture("painted_wall", 3);
    const float gain = float(random_.uniform(0.7, 1.4));
    b_.box(place, {0, width, -kThick / 2, kThick / 2, 0.01, d.height - 0.02}, skin, skin, -1, true, gain);
    b_.box(place, {width - 0.14, width - 0.04, -0.06, 0.06, kHandle, kHandle + 0.03}, metal_, metal_, -1,
           false);
    b_.box(place, {width - 0.1, width - 0.06, -0.03, 0.03, kHandle - 0.12, kHandle + 0.12}, metal_, metal_,
           -1, false);
  }

  double distance_to_walk(const Eigen::Vector3d& p) const {
    double nearest = 1e9;
    for (const Street& leg : path_) nearest = std::min(nearest, leg.distance(p.head<2>()));
    return nearest;
  }

  // Whether something of that width and depth leaves the walk free.
  bool is_clear(const LocalFrame& place, double r, double width, double depth) const {
    constexpr double kClear = 0.45;  // metres
    for (double t : {0.0, 0.25, 0.5, 0.75, 1.0})
      for (double o : {0.0, depth / 2, depth})
        if (distance_to_walk(place.point(r + t * width, o, 0)) < kClear) return false;
    return true;
  }

  void along_wall(const LocalFrame& place, double from, double to, double dado) {
    double r = from + random_.uniform(0, 1.2) / density_;
    while (r + 0.5 < to) {
      r += object(place.moved(r, 0, 0), to - r, dado);
      r += random_.uniform(0.15, 1.6) / density_;
    }
  }

  // One object at the wall, at most `room` wide. Returns its width.
  double object(const LocalFrame& p, double room, double dado) {
    const double what = random_.uniform();
    if (what < 0.3) return on_wall(p, room, dado);
    const double width = std::min(room, random_.uniform(0.4, 1.3)), depth = random_.uniform(0.3, 0.65);
    if (!is_clear(p, 0, width, depth)) return on_wall(p, room, dado);
    if (what < 0.5) return cabinet(p, width, depth);
    if (what < 0.66) return bench(p, width, depth);
    if (what < 0.8) return trolley(p, std::min(width, 0.7), depth);
    if (what < 0.9 && room > 2.2 && is_clear(p, 0, 2.1, 0.95)) return bed(p);
    return bin(p);
  }

  double on_wall(const LocalFrame& p, double room, double dado) {
    const double what = random_.uniform(), z = std::max(dado + 0.12, random_.uniform(1.1, 1.5));
    if (what < 0.3 && room > 1.2) {
      const int frame = b_.any_texture("metal", 6);
      b_.box(p, {0, 1.1, 0, 0.03, 0, 2.15}, frame, frame, b_.any_texture("door", 6), true, 1.1f);
      return 1.1;
    }
    const double w = random_.uniform(0.2, 0.6), h = random_.uniform(0.25, 0.7);
    const int skin = b_.any_texture("metal", 6);
    const char* kinds[] = {"poster", "paper", "screen", "window", "box"};
    const int front = b_.any_texture(kinds[random_.below(5)], 5);
    b_.box(p, {0, w, 0, random_.uniform(0.01, 0.12), z, z + h}, skin, skin, front, false);
    return w;
  }

  double cabinet(const LocalFrame& p, double width, double depth) {
    const double height = random_.uniform(0.7, 2.0);
    const char* kinds[] = {"shelf", "door", "box", "metal", "wood"};
    const int skin = b_.any_texture(random_.uniform() < 0.7 ? "metal" : "wood", 6);
    b_.box(p, {0, width, 0, depth, 0, height}, skin, skin, b_.any_texture(kinds[random_.below(5)], 5), true,
           float(random_.uniform(0.8, 1.4)));
    if (height < 1.3 && random_.uniform() < 0.5) {
      const int small = b_.any_texture("box", 5);
      b_.box(p, {0.1, 0.1 + 0.3 * width, 0.1, 0.8 * depth, height, height + random_.uniform(0.1, 0.4)}, small,
             small, -1, false);
    }
    return width;
  }

  void legs(const LocalFrame& p, double width, double depth, double height) {
    constexpr double kLeg = 0.035;
    for (double r : {0.0, width - kLeg})
      for (double o : {0.05, depth - kLeg})
        b_.box(p, {r, r + kLeg, o, o + kLeg, 0, height}, metal_, metal_, -1, false, 0.6f);
  }

  double bench(const LocalFrame& p, double width, double depth) {
    const int seat = b_.any_texture(random_.uniform() < 0.5 ? "wood" : "metal", 6);
    legs(p, width, depth, 0.44);
    b_.box(p, {0, width, 0.03, depth, 0.44, 0.49}, seat, seat, -1, true, 0.9f);
    b_.box(p, {0, width, 0.03, 0.07, 0.55, 0.9}, seat, seat, -1, true, 0.9f);
    return width;
  }

  double trolley(const LocalFrame& p, double width, double depth) {
    legs(p, width, depth, 1.0);
    for (double z : {0.2, 0.6, 0.97}) b_.box(p, {0, width, 0.05, depth, z, z + 0.03}, metal_, metal_);
    for (int i = 0; i < 3; ++i) {
      const double r = random_.uniform(0, 0.6 * width), size = random_.uniform(0.1, 0.25),
                   z = i == 0 ? 0.23 : 1.0;
      const int skin = b_.any_texture("box", 5);
      b_.box(p, {r, r + size, 0.1, 0.1 + size, z, z + size}, skin, skin, -1, false);
    }
    return width;
  }

  double bed(const LocalFrame& p) {
    const int sheet = b_.any_texture("painted_wall", 3);
    legs(p, 2.05, 0.92, 0.5);
    b_.box(p, {0, 2.05, 0.05, 0.92, 0.42, 0.5}, metal_, metal_, -1, true, 0.8f);
    b_.box(p, {0.05, 2.0, 0.08, 0.9, 0.5, 0.66}, sheet, sheet, -1, true, 1.2f);
    b_.box(p, {0.1, 0.5, 0.2, 0.8, 0.66, 0.76}, sheet, sheet, -1, true, 1.3f);
    b_.box(p, {-0.03, 0, 0.05, 0.92, 0.3, 1.0}, metal_, metal_);
    b_.box(p, {2.05, 2.08, 0.05, 0.92, 0.3, 0.85}, metal_, metal_);
    return 2.1;
  }

  double bin(const LocalFrame& p) {
    const double radius = random_.uniform(0.12, 0.2), height = random_.uniform(0.35, 0.8);
    const LocalFrame middle = p.moved(radius, radius + 0.05, 0);
    b_.prism(middle, radius, height, 10, b_.any_texture("mug", 4), float(random_.uniform(0.5, 1.1)));
    const Eigen::Vector3d right = 2 * radius * p.right, out = 2 * radius * p.out;
    b_.fit(middle.point(-radius, -radius, height), right, out, b_.texture("manhole", 1));  // its lid
    return 2 * radius;
  }

  // Columns and chairs away from the walls.
  void free_standing(const Room& r) {
    const int count = int(density_ * (r.x1 - r.x0) * (r.y1 - r.y0) / 14);
    for (int i = 0; i < count; ++i) {
      const double x = random_.uniform(r.x0 + 0.5, r.x1 - 0.5), y = random_.uniform(r.y0 + 0.5, r.y1 - 0.5);
      const LocalFrame place = facing({x, y, 0}, random_.uniform(0, 6.283));
      if (distance_to_walk(place.origin) < 1.0) continue;
      if (random_.uniform() < 0.3)
        b_.prism(place, random_.uniform(0.1, 0.2), r.height, 12, b_.any_texture("painted_wall", 3));
      else
        bench(place.moved(-0.23, -0.23, 0), 0.46, 0.46);
    }
  }

  WorldBuilder& b_;
  Random& random_;
  double density_;
  RoomPlan plan_;
  std::vector<Street> path_;
  int metal_;
  RoomStyle last_;
};

}  // namespace

void build_tiled_rooms(Site& site) { RoomsBuilder(site).build(); }

}  // namespace edgevo
