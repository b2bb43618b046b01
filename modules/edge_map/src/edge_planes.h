// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The largest plane of a view (a road, a facade, a table) in the depths of its edges.
//
// The image of a plane has inverse depths that are exactly linear in it, as that of a line has along it. What
// runs along the motion, or was seen by too few views to be found, has the depth of the plane that it lies
// on.
#include <Eigen/Core>
#include <vector>

namespace edgevo {

/// Edge pixel of known inverse depth.
struct PlaneSample {
  Eigen::Vector2d px;
  double idepth = 0;
  /// Standard deviations of the error of its own, and of the one that it shares with others.
  double noise = 0, common = 0;

  /// Both together.
  double sigma() const;
};

/// Inverse depth at a pixel, with its standard deviation.
struct PlaneDepth {
  double idepth = 0, sigma = 0;
};

/// A plane: inverse depth (a, b, c) (x, y, 1) at pixel (x, y).
class EdgePlane {
 public:
  /// Least squares over the samples. A plane of too few, or of samples on a line, is not valid.
  explicit EdgePlane(const std::vector<PlaneSample>& samples);

  bool is_valid() const { return is_valid_; }
  /// Samples that it was fitted to.
  int size() const { return size_; }
  /// At a pixel: errors of their own average out, the shared one is carried along, with the samples' relief
  /// over the plane.
  PlaneDepth at(const Eigen::Vector2d& px) const;
  /// Whether a sample lies on it, within three standard deviations of both.
  bool holds(const PlaneSample& sample) const;

 private:
  bool is_valid_ = false;
  int size_ = 0;
  Eigen::Vector2d centre_ = Eigen::Vector2d::Zero();
  Eigen::Vector3d plane_ = Eigen::Vector3d::Zero(), bias_ = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
  double relief_ = 0;  // share of the inverse depth
};

/// The plane again, from those of the samples that lie on it.
EdgePlane refined(EdgePlane plane, const std::vector<PlaneSample>& samples);

/// The plane that most samples lie on; not valid if few do. The same samples give the same plane. Cost: 1 ms
/// for 2000 samples.
EdgePlane find_plane(const std::vector<PlaneSample>& samples);

}  // namespace edgevo
