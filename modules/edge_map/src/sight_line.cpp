// SPDX-License-Identifier: BSD-3-Clause
#include "sight_line.h"

#include <cmath>

#include "edgevo/core/simd.h"

namespace edgevo {
namespace {

// A matrix times (x, y, 1): the order of the sums is Eigen's, which takes the first two rows together.
EDGEVO_WIDE_CLONES void look_along_groups(const ViewGroup* views, size_t count, double x, double y,
                                          double normal_x, double normal_y, SightGroup* sights) {
  for (size_t g = 0; g < count; ++g) {
    const ViewGroup& v = views[g];
    SightGroup& s = sights[g];
    s.h[0] = (v.H[0] * x + v.H[1] * y) + v.H[2];
    s.h[1] = (v.H[3] * x + v.H[4] * y) + v.H[5];
    s.h[2] = v.H[6] * x + (v.H[7] * y + v.H[8]);
    s.normal[0] = v.turn[0] * normal_x + v.turn[1] * normal_y;
    s.normal[1] = v.turn[2] * normal_x + v.turn[3] * normal_y;
  }
}

void put(const ViewGeometry& view, size_t lane, ViewGroup* group) {
  for (int i = 0; i < 9; ++i) group->H[i][lane] = view.H(i / 3, i % 3);
  for (int i = 0; i < 3; ++i) group->e[i][lane] = view.e[i];
  for (int i = 0; i < 4; ++i) group->turn[i][lane] = view.turn(i / 2, i % 2);
}

// Everything lies behind these views.
ViewGroup empty_group() {
  ViewGroup group{};
  group.H[8] -= 1.0;
  return group;
}

}  // namespace

ViewGeometry::ViewGeometry(const Pinhole& c, const EdgeView& view)
    : level(&view.pyramid->finest()), sides(view.sides.get()), inverse_gain(1 / float(view.gain)) {
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity(), K_inverse = Eigen::Matrix3d::Identity();
  K << c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1;
  K_inverse << 1 / c.fx, 0, -c.cx / c.fx, 0, 1 / c.fy, -c.cy / c.fy, 0, 0, 1;
  const Eigen::Matrix3d R = view.T_view_host.R();
  H = K * R * K_inverse;
  e = K * view.T_view_host.translation();
  const double angle = std::atan2(R(1, 0) - R(0, 1), R(0, 0) + R(1, 1));
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
}

ViewSet::ViewSet(const Pinhole& pinhole, const std::vector<EdgeView>& all)
    : groups((all.size() + kViewsAtOnce - 1) / kViewsAtOnce, empty_group()) {
  for (size_t v = 0; v < all.size(); ++v) {
    views.emplace_back(pinhole, all[v]);
    put(views.back(), v % kViewsAtOnce, &groups[v / kViewsAtOnce]);
  }
}

void look_along(const ViewSet& set, const Eigen::Vector2d& px, const Eigen::Vector2d& normal,
                std::vector<SightGroup>* sights) {
  sights->resize(set.groups.size());
  look_along_groups(set.groups.data(), set.groups.size(), px.x(), px.y(), normal.x(), normal.y(),
                    sights->data());
}

}  // namespace edgevo
