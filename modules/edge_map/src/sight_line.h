// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Projection of the ray of a host pixel into other images, as a function of its inverse depth.
#include <Eigen/Core>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/edge_map/edge_depth.h"

namespace edgevo {

/// View with the quantities that are common to all pixels of the host.
struct ViewGeometry {
  ViewGeometry(const Pinhole& pinhole, const EdgeView& view);

  const PyramidLevel* level;
  const std::vector<EdgeSides>* sides;
  /// K R K^-1, the homography at infinity.
  Eigen::Matrix3d H;
  /// K t, the epipole.
  Eigen::Vector3d e;
  /// Rotation of image directions about the optical axis.
  Eigen::Matrix2d turn;
  /// One over the brightness of the view over that of the host.
  float inverse_gain;
};

/// Projected ray p(rho) = (h + rho e)_xy / (h + rho e)_z, pixels.
struct SightLine {
  SightLine(const ViewGeometry& view, const Eigen::Vector2d& px_host)
      : h(view.H * Eigen::Vector3d(px_host.x(), px_host.y(), 1)), e(view.e) {}

  /// Depth in the view over that in the host.
  double depth(double idepth) const { return h.z() + idepth * e.z(); }
  /// Projected position at an inverse depth, pixels.
  Eigen::Vector2d at(double idepth) const { return (h.head<2>() + idepth * e.head<2>()) / depth(idepth); }
  /// Derivative dp / d rho at p = at(idepth).
  Eigen::Vector2d slope(double idepth, const Eigen::Vector2d& p) const {
    return (e.head<2>() - p * e.z()) / depth(idepth);
  }
  /// Inverse depth at which the line passes `p`, computed along the image axis closest to its `direction`.
  double idepth_at(const Eigen::Vector2d& p, const Eigen::Vector2d& direction) const {
    const int axis = std::abs(direction.x()) > std::abs(direction.y()) ? 0 : 1;
    return (p[axis] * h.z() - h[axis]) / (e[axis] - p[axis] * e.z());
  }

  Eigen::Vector3d h, e;
};

/// Four doubles, of four views: one register with AVX2, two without.
using FourViews = double __attribute__((vector_size(32)));
constexpr size_t kViewsAtOnce = 4;

/// ViewGeometry of four views. H and turn row by row.
struct alignas(32) ViewGroup {
  FourViews H[9], e[3], turn[4];
};

/// Sight lines of a host pixel in four views, and the normal of its edge as seen there.
struct alignas(32) SightGroup {
  FourViews h[3], normal[2];
};

/// All views of a host, also in groups. The last group is filled up with views that contain nothing.
struct ViewSet {
  ViewSet(const Pinhole& pinhole, const std::vector<EdgeView>& all);

  std::vector<ViewGeometry> views;
  std::vector<ViewGroup> groups;
};

/// The sight lines in all views, with the bits of SightLine and of a product with ViewGeometry::turn.
void look_along(const ViewSet& set, const Eigen::Vector2d& px, const Eigen::Vector2d& normal,
                std::vector<SightGroup>* sights);

}  // namespace edgevo
