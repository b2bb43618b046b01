// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The match of one projected point: the nearest edge pixel that passes the gates of Eq. (edgeerror).
#include <cmath>

#include "edgevo/alignment/alignment_params.h"
#include "edgevo/alignment/projection.h"
#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// Gate on the angle between the two edge normals, signed: 45 degrees.
constexpr double kMinNormalCosine = 0.7;

/// Edge pixel that a projected point is matched with.
struct EdgeMatch {
  /// Whether there is one; the other members hold then.
  bool found = false;
  /// Unit gradient g(n) of the edge.
  Eigen::Vector2d normal;
  /// Residual of Eq. (edgeerror), g(n)^T (p' - n(p')), pixels.
  double residual_px = 0;
  /// Number of the edge that n(p') belongs to; -1 if there is none.
  int chain = -1;
};

/// Matches the projection `px`. `point_normal` is the edge normal in the reference image.
inline EdgeMatch match_edge(const PyramidLevel& level, const Eigen::Vector2d& px,
                            const Eigen::Vector2f& point_normal, const AlignmentParams& params) {
  const int n = level.field.nearest(float(px.x()), float(px.y()));
  if (n < 0) return {};
  const EdgePixel& edge = level.edges.pixels[n];
  if (!(edge.normal().dot(point_normal) >= kMinNormalCosine)) return {};
  const Eigen::Vector2d g = edge.normal().cast<double>();
  const Eigen::Vector2d d = px - edge.position().cast<double>();
  const double r = g.dot(d);  // Eq. (edgeerror)
  const double tangent = g.x() * d.y() - g.y() * d.x();
  if (std::abs(r) > params.truncation_normal_px || std::abs(tangent) > params.truncation_tangent_px)
    return {};
  return {true, g, r, edge.chain};
}

/// Weight of a point given its uncertain depth: w = 1 / (1 + s^2), where s is the standard deviation of its
/// projection along `normal`, pixels.
inline double depth_weight(const Eigen::Matrix<double, 2, 3>& J_pi, const Eigen::Vector3d& t,
                           const Eigen::Vector2d& normal, double idepth_sigma) {
  const double s = normal.dot(J_pi * t) * idepth_sigma;
  return 1.0 / (1.0 + s * s);
}

}  // namespace edgevo
