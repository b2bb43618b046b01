// SPDX-License-Identifier: BSD-3-Clause
#include "sight_line.h"

#include <cmath>

namespace edgevo {

ViewGeometry::ViewGeometry(const Pinhole& c, const EdgeView& view)
    : level(&view.pyramid->finest()), sides(view.sides.get()), gain(view.gain) {
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity(), K_inverse = Eigen::Matrix3d::Identity();
  K << c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1;
  K_inverse << 1 / c.fx, 0, -c.cx / c.fx, 0, 1 / c.fy, -c.cy / c.fy, 0, 0, 1;
  const Eigen::Matrix3d R = view.T_view_host.R();
  H = K * R * K_inverse;
  e = K * view.T_view_host.translation();
  const double angle = std::atan2(R(1, 0) - R(0, 1), R(0, 0) + R(1, 1));
  turn << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
}

}  // namespace edgevo
