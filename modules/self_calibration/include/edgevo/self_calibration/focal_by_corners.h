// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The focal length from corners that are followed through the images (features/feature_tracker.h). Matches of
// edges are sought where the map predicts them, and the map was made with the camera file: of a large error
// they show a part. Corners are followed without the map, so that a bundle of their own, poses and
// depths free, shows most of it once the camera has turned.
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/core/rectification.h"
#include "edgevo/core/se3.h"
#include "edgevo/features/followed_corner.h"

namespace edgevo {

/// What corners say of the focal length.
struct FocalError {
  /// True focal length over that of the file, less 1.
  double value = 0;
  /// Its standard deviation.
  double sigma = 0;
  /// Number of windows that it is the median of.
  int windows = 1;
};

/// Largest error that is found, to either side: a true one beyond it comes out as this.
constexpr double kMaxFocalError = kLargestCameraError[size_t(CameraNumber::kFocal)];

/// Measures the focal length in windows of views, for one thread; deterministic.
class FocalByCorners {
 public:
  /// For images that are rectified as `rectification` says.
  explicit FocalByCorners(const Rectification& rectification);
  ~FocalByCorners();
  FocalByCorners(FocalByCorners&&) noexcept;

  /// Takes the corners of the next image, with the lens by which it was corrected, and the motion since the
  /// last image, in any unit; nothing: the motion is unknown, and a new window begins.
  /// Cost: hardly any, but 3 ms where a window in which the camera has turned is complete; at most nine
  /// such windows are measured.
  void add(const std::vector<FollowedCorner>& corners, const std::optional<SE3>& T_cur_last,
           const ImageCorrection& lens);
  /// The windows up to now together, against the file and not against what is applied; nothing: fewer than
  /// three have shown the focal length.
  std::optional<FocalError> error() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace edgevo
