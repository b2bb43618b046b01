// SPDX-License-Identifier: BSD-3-Clause
// A road that leaves a village or a wood for open land, in which all is far but the road itself. The
// camera drives to and fro.
#include <algorithm>
#include <cmath>

#include "props.h"
#include "street_plan.h"
#include "worlds.h"

namespace edgevo {
namespace {

constexpr double kHalfRoad = 3.4;  // metres
constexpr double kBefore = 60;     // length of the road before the first waypoint, metres
constexpr double kAfter = 420;     // and after the last one
constexpr double kLand = 420;      // width of the land on either side, metres
constexpr double kLift = 0.004;    // paint above the road, metres

class OpenLandBuilder {
 public:
  explicit OpenLandBuilder(Site& site)
      : site_(site),
        b_(site.build),
        random_(b_.random()),
        density_(site.params.world.density),
        roads_(roads(site)) {
    const double drive = length_of(site.params.waypoints);
    near_end_ = kBefore + random_.uniform(0.18, 0.27) * drive;
    clear_ = random_.uniform(45, 80);
    // Beyond the farthest point of a drive, which may end before its last waypoint.
    far_start_ = kBefore + drive + random_.uniform(30, 90);
    is_dike_ = random_.uniform() < 0.5;
    drop_ = random_.uniform(2, 6);
    has_marks_ = random_.uniform() < 0.6;
    has_rims_ = random_.uniform() < 0.6;
    field_ = b_.texture("meadow", random_.below(3));
  }

  void build() {
    land();
    for (const Street& road : roads_) surface(road);
    for (double sign : {1.0, -1.0}) {
      near_objects(sign);
      far_objects(sign);
    }
    skyline();
  }

 private:
  static double length_of(const std::vector<Eigen::Vector3d>& points) {
    double length = 0;
    for (size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
    return length;
  }

  // Of each leg; only the first and the last reach beyond the waypoints.
  static std::vector<Street> roads(const Site& site) {
    std::vector<Street> all = streets_of(site.params.waypoints, kBefore, 0, 0);
    all.back().length += kAfter;
    return all;
  }

  // Side of the road at `s` metres from its start, and there the remaining part of s.
  Side side_at(double* s, double sign) const {
    size_t i = 0;
    for (; i + 1 < roads_.size() && *s > roads_[i].length; ++i) *s -= roads_[i].length;
    return {&roads_[i], sign};
  }
  LocalFrame place(double s, double d, double sign) const {
    const Side side = side_at(&s, sign);
    return side.place(s, d, 0);
  }
  double whole() const {
    double length = 0;
    for (const Street& road : roads_) length += road.length;
    return length;
  }

  // Level ground; with a dike, the land of the open land lies lower and slopes lead down to it.
  void land() {
    const Eigen::Vector2d along = roads_.front().along;
    const LocalFrame start = facing({roads_.front().start.x(), roads_.front().start.y(), 0},
                                    std::atan2(along.x(), -along.y()));  // its right runs along the road
    const double step = is_dike_ ? drop_ : 0.03;
    const double split = is_dike_ ? near_end_ + 6 : near_end_;
    plane(start, -kLand, split, -0.03);
    plane(start, split, whole(), -step);
    if (!is_dike_) return;
    for (const Street& road : roads_)
      for (double sign : {1.0, -1.0}) slope({&road, sign});
  }
  void plane(const LocalFrame& start, double s0, double s1, double z) {
    const Eigen::Vector3d right = (s1 - s0) * start.right, out = 2 * kLand * start.out;
    b_.tile(start.point(s0, -kLand, z), right, out, field_).is_two_sided = true;
  }
  void slope(const Side& side) {
    constexpr double kVerge = 1.2, kGrade = 1.7;
    const double w = side.street->length, d = kHalfRoad + kVerge;
    const LocalFrame p = side.left_end(0, w, 0, 0);
    b_.tile(p.point(0, -d, -0.02), w * p.right, kVerge * p.out, field_).is_two_sided = true;
    const Eigen::Vector3d crown = p.point(0, -d, -0.02), foot = p.point(0, -d - kGrade * drop_, -drop_);
    b_.tile(foot, w * p.right, crown - foot, field_).is_two_sided = true;
  }

  void surface(const Street& road) {
    const Side left{&road, 1};
    const double over = &road == &roads_.back() ? 0 : 1;  // closes the wedge in the bend
    strip(left, 0, road.length + over, -kHalfRoad, kHalfRoad, 0, "worn_asphalt");
    for (double d : {-kHalfRoad + 0.25, kHalfRoad - 0.25})
      if (has_rims_) strip(left, 0, road.length, d - 0.07, d + 0.07, kLift, "paint");
    if (!has_marks_) return;
    constexpr double kDash = 4, kPeriod = 12;
    for (double s = 2; s + kDash < road.length; s += kPeriod)
      strip(left, s, s + kDash, -0.06, 0.06, kLift, "paint");
  }
  // From d0 to d1 left of the middle.
  void strip(const Side& left, double s0, double s1, double d0, double d1, double z, const char* kind) {
    const LocalFrame p = left.place(s0, 0, z);
    b_.tile(p.point(0, -d0, 0), -(d1 - d0) * p.out, (s1 - s0) * p.right, b_.texture(kind, 0)).is_two_sided =
        true;
  }

  void near_objects(double sign) {
    for (double s = 2; s < near_end_;) {
      const double d = random_.uniform(4.6, 9), what = random_.uniform();
      const LocalFrame p = place(s, d, sign);
      if (what < 0.3)
        add_tree(b_, p, random_.uniform(4, 9));
      else if (what < 0.42)
        add_bush(b_, p, random_.uniform(1, 2.5));
      else if (what < 0.52)
        add_lamp(b_, p);
      else if (what < 0.6)
        add_sign(b_, p.moved(0, 0, 0, sign * 1.3));
      else if (what < 0.72)
        add_car(b_, place(s, random_.uniform(4.5, 5.2), sign));
      else if (what < 0.85)
        fence(s, sign);
      else
        s += house(s, sign);
      s += random_.uniform(2, 6) / density_;
    }
  }
  void fence(double s, double sign) {
    const double length = std::min(random_.uniform(4, 12), near_end_ - s), height = random_.uniform(0.8, 1.6);
    Side side = side_at(&s, sign);
    const int skin = b_.any_texture(random_.uniform() < 0.5 ? "boards" : "hedge", 3);
    b_.box(side.left_end(s, length, 7.5), {0, length, -0.1, 0.1, 0, height}, skin, skin);
  }
  double house(double s, double sign) {
    const double width = random_.uniform(7, 12), d = random_.uniform(8.5, 13);
    const Side side = side_at(&s, sign);
    add_house(b_, side.left_end(s, width, d), width, 8, 1 + random_.below(2), any_wall());
    return width;
  }
  const std::string& any_wall() { return site_.walls[size_t(random_.below(int(site_.walls.size())))]; }

  // Farms, trees and barns of the open land, none nearer than clear_ to any point of the drive on it.
  void far_objects(double sign) {
    for (double s = near_end_; s < whole() - 40; s += random_.uniform(8, 30) / density_) {
      const double least = s < far_start_ ? clear_ : random_.uniform(6, clear_);
      const double d = least + 180 * std::pow(random_.uniform(), 2);
      far_object(s, d, sign);
    }
  }
  void far_object(double s, double d, double sign) {
    const double z = is_dike_ ? -drop_ : 0, what = random_.uniform();
    const LocalFrame p = place(s, d, sign).moved(0, 0, z, random_.uniform(-0.6, 0.6));
    if (what < 0.45)
      add_tree(b_, p, random_.uniform(6, 16));
    else if (what < 0.65)
      add_conifer(b_, p, random_.uniform(8, 20));
    else if (what < 0.85)
      add_house(b_, p, random_.uniform(8, 18), 9, 1 + random_.below(3), any_wall());
    else
      mast(p);
  }
  void mast(const LocalFrame& p) {
    const double height = random_.uniform(12, 30);
    const int metal = b_.any_texture("metal", 8);
    b_.prism(p, 0.25, height, 6, metal, 0.5f);
    b_.box(p, {-2.5, 2.5, -0.15, 0.15, 0.85 * height, 0.85 * height + 0.35}, metal, metal, -1, false, 0.5f);
  }

  // Woods around the land, in rows of cards of different height and distance.
  void skyline() {
    const Eigen::Vector2d along = roads_.front().along, start = roads_.front().start;
    const Eigen::Vector2d middle = start + 0.5 * (kBefore + near_end_) * along;
    for (double angle = 0; angle < 6.283; angle += random_.uniform(0.035, 0.07)) {
      const double distance = random_.uniform(250, 390), width = random_.uniform(22, 45);
      const double height = random_.uniform(8, 20);
      const Eigen::Vector2d p = middle + distance * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      b_.card(facing({p.x(), p.y(), is_dike_ ? -drop_ - 0.5 : -0.5}, angle + 3.14159), width, height, 0,
              b_.any_texture("forest", 4), float(random_.uniform(0.7, 1.1)));
    }
  }

  Site& site_;
  WorldBuilder& b_;
  Random& random_;
  double density_;
  std::vector<Street> roads_;
  double near_end_ = 0, clear_ = 0, far_start_ = 0, drop_ = 0;
  bool is_dike_ = false, has_marks_ = false, has_rims_ = false;
  int field_ = 0;
};

}  // namespace

void build_open_land(Site& site) { OpenLandBuilder(site).build(); }

}  // namespace edgevo
