// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The similarity between the positions of a run and those of a sensor, in which groups of positions may each
// be displaced (Umeyama 1991), and how probable its residuals are.
#include <optional>
#include <vector>

#include "edgevo/scale/track_scale.h"

namespace edgevo {

using Vectors = std::vector<Eigen::Vector3d>;

/// Axes of the residuals: a vehicle moves in a plane.
constexpr double kMotionAxes = 2;

/// target ~ scale R source + offset of the group.
struct GroupedFit {
  double scale = 0;
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  /// Summed squares of the sources about the means of their groups.
  double spread = 0;
  /// Of the groups.
  Vectors offsets;
  /// Of the pairs; the arms are R (source - mean of its group).
  Vectors residuals, arms;
};

/// Fits one list of pairs with any grouping.
class TrackRegression {
 public:
  /// `sensor_in_camera`, metres, is placed by `scale`, metres per unit; 0: the sensor is at the camera.
  TrackRegression(const std::vector<TrackPair>& pairs, const Eigen::Vector3d& sensor_in_camera, double scale);
  /// Number of pairs.
  size_t size() const { return source_.size(); }
  /// `group` of each pair, from 0 on. nullopt for positions without spread.
  std::optional<GroupedFit> fit(const std::vector<int>& group) const;
  /// Residuals of all pairs in a fit to some of them; `group` of each.
  Vectors residuals(const GroupedFit& fit, const std::vector<int>& group) const;
  /// Whether each jump is more than an error of the camera's own step there.
  bool is_beyond_steps(const GroupedFit& fit, const std::vector<int>& group) const;

 private:
  Vectors source_, target_;
};

/// Correlation of neighbours, 0 to 1.
double autocorrelation(const Vectors& residuals);
/// Sum of the squared innovations of residuals as an autoregressive process of first order: white as those of
/// GPS, or a random walk as those of wheels.
double innovations(const Vectors& residuals);

}  // namespace edgevo
