#pragma once
// Where the ray of a host pixel is seen in another image, as a function of its inverse depth.
#include <Eigen/Core>

#include "edgevo/core/camera.h"
#include "edgevo/edge_map/edge_depth.h"

namespace edgevo {

/// An image, and what is the same for all pixels of the host.
struct ViewGeometry {
  ViewGeometry(const Pinhole& pinhole, const EdgeView& view);

  const PyramidLevel* level;
  const std::vector<EdgeSides>* sides;
  Eigen::Matrix3d H;     ///< K R K^-1: of a pixel infinitely far away
  Eigen::Vector3d e;     ///< K t
  Eigen::Matrix2d turn;  ///< of directions, by the rotation about the optical axis
  double gain;
};

/// p(rho) = (h + rho e)_xy / (h + rho e)_z, pixels.
struct SightLine {
  SightLine(const ViewGeometry& view, const Eigen::Vector2d& px_host)
      : h(view.H * Eigen::Vector3d(px_host.x(), px_host.y(), 1)), e(view.e) {}

  double depth(double idepth) const { return h.z() + idepth * e.z(); }
  Eigen::Vector2d at(double idepth) const { return (h.head<2>() + idepth * e.head<2>()) / depth(idepth); }
  /// d p / d rho, where p = at(idepth).
  Eigen::Vector2d slope(double idepth, const Eigen::Vector2d& p) const {
    return (e.head<2>() - p * e.z()) / depth(idepth);
  }
  /// The inverse depth at which it passes `p`, by the image axis along which the line runs.
  double idepth_at(const Eigen::Vector2d& p, const Eigen::Vector2d& direction) const {
    const int axis = std::abs(direction.x()) > std::abs(direction.y()) ? 0 : 1;
    return (p[axis] * h.z() - h[axis]) / (e[axis] - p[axis] * e.z());
  }

  Eigen::Vector3d h, e;
};

}  // namespace edgevo
