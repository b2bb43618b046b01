// SPDX-License-Identifier: BSD-3-Clause
#include "straight_line.h"

#include <cmath>

namespace edgevo {
namespace {
constexpr float kAcrossPx = 1.0f;  // from the chord: an edge is found to half a pixel
constexpr float kSigmas = 3;
}  // namespace

bool is_straight(const std::vector<EdgeVertex>& vertices) {
  const EdgeVertex &a = vertices.front(), &b = vertices.back();
  const Eigen::Vector2f chord = b.px - a.px;
  const float length = chord.norm();
  if (!(length > 0)) return false;
  for (const EdgeVertex& v : vertices) {
    const Eigen::Vector2f d = v.px - a.px;
    if (std::abs(chord.x() * d.y() - chord.y() * d.x()) > kAcrossPx * length) return false;
    const float share = chord.dot(d) / (length * length);
    const float idepth = a.idepth + share * (b.idepth - a.idepth);
    if (std::abs(v.idepth - idepth) > kSigmas * (v.idepth_sigma + std::max(a.idepth_sigma, b.idepth_sigma)))
      return false;
  }
  return true;
}

}  // namespace edgevo
