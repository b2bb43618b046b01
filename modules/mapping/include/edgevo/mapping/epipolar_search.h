// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The depth of an edge point from one other image: searches its epipolar line, among edges of compatible
// direction, for the position that looks most alike.
#include <Eigen/Core>
#include <cmath>

#include "edgevo/association/association_params.h"
#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/mapping/mapping_params.h"

namespace edgevo {

/// Range of the inverse depth of a new point.
struct IdepthRange {
  /// Bounds, 0 < low < high.
  double low = 0, high = 0;
  /// Best guess within the bounds; 0: the geometric mean is the best guess.
  double likely = 0;
  /// The likeliest inverse depth.
  double guess() const { return likely > 0 ? likely : std::sqrt(low * high); }
};

/// How a search ended; only kFound yields a depth.
enum class EpipolarOutcome {
  kFound,
  /// The segment is too short to show a depth.
  kNoBaseline,
  /// The segment is outside the target image.
  kOutOfView,
  /// The edge runs along its epipolar line, so that their intersection is undefined: not searched.
  kAlongLine,
  /// No edge of compatible direction looks alike.
  kNoMatch,
  /// Two positions look alike.
  kAmbiguous,
};

/// Result of an epipolar search.
struct EpipolarMatch {
  /// How the search ended; the other members hold for kFound only.
  EpipolarOutcome outcome = EpipolarOutcome::kNoMatch;
  /// Inverse depth 1/z in the host frame, and its standard deviation.
  double idepth = 0, idepth_sigma = 0;
  /// Matched pixel in the target image.
  Eigen::Vector2d px;
};

/// Searches the target image for the host point over the inverse depths of `range`.
EpipolarMatch search_epipolar(const FramePyramid& host, const FramePyramid& target,
                              const Eigen::Vector2d& px_host, const Eigen::Vector2d& normal_host,
                              const SE3& T_target_host, const IdepthRange& range,
                              const DepthFilterParams& params);

/// Inverse depth at which the ray (rotated into the target: R x) meets target pixel `px`, using the image
/// axis along which the epipolar line runs; not finite without a baseline.
double triangulate_idepth(const Pinhole& camera, const Eigen::Vector3d& rotated_ray, const Eigen::Vector3d& t,
                          const Eigen::Vector2d& px, const Eigen::Vector2d& epipolar_direction);

}  // namespace edgevo
