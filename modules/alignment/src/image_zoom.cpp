// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/image_zoom.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

constexpr double kZoomRidge = 1e-9;    // px^-2, added to the information of the pose: it is invertible then
constexpr double kAllAbsorbed = 1e-6;  // share of the information that no pose absorbs: less is rounding
constexpr double kUnknowns = 7;        // of a pose and the zoom

// Residual that an enlargement makes, for each pixel that it is at the edge of the image.
double residual_of_zoom(const PoseEquation& e) { return e.normal.dot(e.at); }

// Number that the numbers of all edges are below.
int edges_in(const std::vector<PoseEquation>& equations) {
  int edges = 0;
  for (const PoseEquation& e : equations) edges = std::max(edges, e.edge + 1);
  return edges;
}

}  // namespace

// As correlated_residual.h has it for six numbers: b' = b - J x is what no pose absorbs, x what the pose
// does.
ImageZoom image_zoom(const std::vector<PoseEquation>& equations, double half_width_px, double depth) {
  Matrix6d A = kZoomRidge * Matrix6d::Identity();
  Vector6d c = Vector6d::Zero();
  for (const PoseEquation& e : equations) {
    const Vector6d w_j = e.weight * e.jacobian.transpose();
    A.noalias() += w_j * e.jacobian;
    c += residual_of_zoom(e) * w_j;
  }
  const Vector6d x = A.ldlt().solve(c);
  std::vector<double> score(size_t(edges_in(equations)), 0.0);
  double information = 0, of_all = 0;
  for (const PoseEquation& e : equations) {
    const double left = residual_of_zoom(e) - e.jacobian.dot(x);
    score[size_t(e.edge)] += e.weight * e.residual_px * left;
    information += e.weight * left * left;
    of_all += e.weight * residual_of_zoom(e) * residual_of_zoom(e);
  }
  double sum = 0, squares = 0, edges = 0;
  for (const double s : score) sum += s, squares += s * s, edges += s != 0;
  if (!(information > kAllAbsorbed * of_all) || edges <= kUnknowns) return {};
  squares *= edges / (edges - kUnknowns);
  const double per_share = information * half_width_px;
  return {sum / per_share, std::sqrt(kReferenceShare * squares) / per_share,
          x.head<3>().norm() * half_width_px / depth};
}

}  // namespace edgevo
