// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/image_zoom.h"

#include <cmath>

#include "affine_sums.h"

namespace edgevo {

// As correlated_residual.h has it, for the one affine motion that is an enlargement, (x, y) times z.
ImageZoom image_zoom(const std::vector<PoseEquation>& equations, double half_width_px, double depth) {
  constexpr double kUnknowns = 7;  // of a pose and the zoom
  const AffineSums sums(equations);
  const Matrix6d X = sums.absorbed();
  const Vector6d z = (Vector6d() << 0, 1, 0, 0, 0, 1).finished();
  const double of_all = z.dot(sums.of_affine * z);
  const double information = of_all - z.dot(sums.across.transpose() * X * z);  // that no pose absorbs
  double sum = 0, squares = 0, edges = 0;
  for (const AffineScore& edge : sums.of_edge) {
    const double s = z.dot(edge.by_affine - X.transpose() * edge.by_pose);
    sum += s, squares += s * s, edges += s != 0;
  }
  if (!(information > kAbsorbedShare * of_all) || edges <= kUnknowns) return {};
  squares *= edges / (edges - kUnknowns);
  const double per_share = information * half_width_px;
  return {sum / per_share, std::sqrt(kReferenceShare * squares) / per_share,
          (X * z).head<3>().norm() * half_width_px / depth};
}

}  // namespace edgevo
