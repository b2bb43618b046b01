// SPDX-License-Identifier: BSD-3-Clause
#include "room_plan.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "drive_path.h"
#include "edgevo/core/error.h"

namespace edgevo {
namespace {

constexpr uint64_t kPlanPurpose = 0x726f6f6d73;
constexpr int kMinFrames = 150, kMaxFrames = 200;
constexpr int kTries = 5000;
constexpr double kNextToDoor = 0.4;  // least wall next to a doorway, metres
constexpr double kStraight = 0.9;    // the walk goes straight this far before and after a doorway, metres
constexpr double kFromWall = 1.0;    // least distance of its other waypoints from a wall, metres

const Eigen::Vector2d kOutwards[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

int opposite(int side) { return (side + 2) % 4; }
bool is_across(int side) { return side == kEast || side == kWest; }

// Ends of a wall in x or y.
double low_end(const Room& r, int side) { return is_across(side) ? r.y0 : r.x0; }
double high_end(const Room& r, int side) { return is_across(side) ? r.y1 : r.x1; }

Eigen::Vector2d middle_of(const Room& r, const Doorway& d) {
  if (is_across(d.side)) return {d.side == kEast ? r.x1 : r.x0, d.middle};
  return {d.middle, d.side == kNorth ? r.y1 : r.y0};
}

bool overlap(const Room& a, const Room& b, double gap) {
  return a.x0 < b.x1 + gap && b.x0 < a.x1 + gap && a.y0 < b.y1 + gap && b.y0 < a.y1 + gap;
}

// Draws plans until the walk through one fits.
class Planner {
 public:
  Planner(const SceneParams& params, uint64_t seed, const std::string& where)
      : params_(params), random_(Random::derive(seed, kPlanPurpose)), where_(where) {}

  RoomPlan plan() {
    for (int i = 0; i < kTries; ++i)
      if (std::optional<RoomPlan> found = one_plan()) return *found;
    throw InputError(where_, "no walk through rooms fits its speed and turns", "take another seed");
  }

 private:
  std::optional<RoomPlan> one_plan() {
    plan_ = RoomPlan();
    plan_.wall_m = random_.uniform(0.1, 0.25);
    height_ = random_.uniform(2.5, 3.4);
    plan_.rooms.push_back(room_of(any_size()));
    const int count = 3 + random_.below(4);
    for (int side = random_.below(4); int(plan_.rooms.size()) < count; side = next_side(side))
      if (!add_room(side)) return std::nullopt;
    add_waypoints();
    return walk_fits() ? std::optional<RoomPlan>(plan_) : std::nullopt;
  }

  // Halls are narrow and long; the length of the others is at most twice their width.
  Eigen::Vector2d any_size() {
    const bool is_hall = random_.uniform() < 0.3;
    const double a = is_hall ? random_.uniform(2.3, 3) : random_.uniform(3.5, 8);
    const double b = is_hall ? random_.uniform(6, 12) : random_.uniform(4, 8);
    return random_.uniform() < 0.5 ? Eigen::Vector2d(a, b) : Eigen::Vector2d(b, a);
  }
  Room room_of(const Eigen::Vector2d& size) { return {0, size.x(), 0, size.y(), height_, {}}; }

  // Left, right or straight on.
  int next_side(int side) {
    const double what = random_.uniform();
    return (side + (what < 0.42 ? 1 : what < 0.84 ? 3 : 0)) % 4;
  }

  // A room beyond the last one, behind a doorway in its wall on `side`. False if there is no place for it.
  bool add_room(int side) {
    Room& from = plan_.rooms.back();
    Room to = room_of(any_size());
    Doorway out{side, 0, random_.uniform(0.95, 1.7), random_.uniform(2.0, 2.25)};
    const double margin = out.width / 2 + kNextToDoor;
    out.middle = random_.uniform(low_end(from, side) + margin, high_end(from, side) - margin);
    Doorway in = out;
    in.side = opposite(side);
    const double in_wall = random_.uniform(margin, to.length(side) - margin), t = plan_.wall_m;
    const double w = to.x1, h = to.y1;
    if (is_across(side)) {
      to.x0 = side == kEast ? from.x1 + t : from.x0 - t - w;
      to.y0 = out.middle - in_wall;
    } else {
      to.y0 = side == kNorth ? from.y1 + t : from.y0 - t - h;
      to.x0 = out.middle - in_wall;
    }
    to.x1 = to.x0 + w, to.y1 = to.y0 + h;
    for (const Room& other : plan_.rooms)
      if (overlap(other, to, 0.9 * t)) return false;
    from.doorways.push_back(out);
    to.doorways.push_back(in);
    plan_.rooms.push_back(to);
    return true;
  }

  Eigen::Vector2d inside(const Room& r) {
    const auto between = [&](double low, double high) {
      const double margin = std::min(kFromWall, 0.49 * (high - low));
      return random_.uniform(low + margin, high - margin);
    };
    const double x = between(r.x0, r.x1);
    return {x, between(r.y0, r.y1)};
  }

  void add(const Eigen::Vector2d& p) { plan_.waypoints.emplace_back(p.x(), p.y(), 0); }

  void add_waypoints() {
    for (const Room& room : plan_.rooms) {
      const bool is_first = &room == &plan_.rooms.front(), is_last = &room == &plan_.rooms.back();
      if (is_first || is_last || random_.uniform() < 0.5) add(inside(room));
      if (is_last) break;
      const Doorway& out = room.doorways.back();
      const Eigen::Vector2d ahead = kOutwards[out.side], middle = middle_of(room, out);
      add(middle - kStraight * ahead);
      add(middle + (plan_.wall_m + kStraight) * ahead);
    }
  }

  // Cuts the walk at kMaxFrames.
  bool walk_fits() {
    SceneParams walk = params_;
    walk.waypoints = plan_.waypoints;
    try {
      const int frames = int(seconds_along(walk, where_) * params_.rate_hz) - 1;
      plan_.frames = std::min(frames, kMaxFrames);
      return frames >= kMinFrames;
    } catch (const InputError&) {
      return false;  // a leg is too short for its turn
    }
  }

  const SceneParams& params_;
  Random random_;
  const std::string where_;
  RoomPlan plan_;
  double height_ = 0;
};

}  // namespace

LocalFrame Room::wall(int side) const {
  constexpr double kQuarter = 3.14159265358979323846 / 2;
  const Eigen::Vector3d left[] = {{x1, y1, 0}, {x0, y1, 0}, {x0, y0, 0}, {x1, y0, 0}};
  return facing(left[side], kQuarter * (side + 2));
}

double Room::left_end(const Doorway& d) const {
  const bool runs_back = d.side == kEast || d.side == kSouth;
  return (runs_back ? high_end(*this, d.side) - d.middle : d.middle - low_end(*this, d.side)) - d.width / 2;
}

RoomPlan plan_rooms(const SceneParams& params, uint64_t seed, const std::string& where) {
  return Planner(params, seed, where).plan();
}

}  // namespace edgevo
