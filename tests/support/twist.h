// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A tangent vector of SE(3) from its six numbers.
#include "edgevo/core/se3.h"

namespace edgevo::test {

/// [v, w]: translation part first.
inline Vector6d twist(double vx, double vy, double vz, double wx, double wy, double wz) {
  Vector6d xi;
  xi << vx, vy, vz, wx, wy, wz;
  return xi;
}

}  // namespace edgevo::test
