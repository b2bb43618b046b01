#pragma once
// The depth of an edge point by one other image: search along its epipolar line among edges of compatible
// direction, the place that looks most alike.
#include <Eigen/Core>
#include <cmath>

#include "edgevo/association/association_params.h"
#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/mapping/mapping_params.h"

namespace edgevo {

/// Where the inverse depth of a new point may lie.
struct IdepthRange {
  double low = 0, high = 0;  ///< bounds, 0 < low < high
  double likely = 0;         ///< best guess within; 0: no better one than the geometric mean
  double guess() const { return likely > 0 ? likely : std::sqrt(low * high); }  ///< the likeliest value
};

/// How a search ended; only kFound tells a depth.
enum class EpipolarOutcome {
  kFound,
  kNoBaseline,  ///< the segment is too short to tell anything
  kOutOfView,
  kAlongLine,  ///< the edge runs along its epipolar line, which it crosses anywhere: not searched
  kNoMatch,    ///< no edge of compatible direction looks alike
  kAmbiguous,  ///< two places look alike
};

/// The depth that one image tells.
struct EpipolarMatch {
  EpipolarOutcome outcome = EpipolarOutcome::kNoMatch;  ///< all below holds for kFound only
  double idepth = 0, idepth_sigma = 0;                  ///< 1/z in the host frame, and one standard deviation
  Eigen::Vector2d px;                                   ///< the match, in the target image
};

/// Looks for the host point in the target image over the inverse depths of `range`.
EpipolarMatch search_epipolar(const FramePyramid& host, const FramePyramid& target,
                              const Eigen::Vector2d& px_host, const Eigen::Vector2d& normal_host,
                              const SE3& T_target_host, const IdepthRange& range,
                              const DepthFilterParams& params);

/// Inverse depth at which the ray (rotated into the target: R x) meets target pixel `px`, using the image
/// axis along which the epipolar line runs; not finite where there is no baseline.
double triangulate_idepth(const Pinhole& camera, const Eigen::Vector3d& rotated_ray, const Eigen::Vector3d& t,
                          const Eigen::Vector2d& px, const Eigen::Vector2d& epipolar_direction);

}  // namespace edgevo
