// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The pose between two views by corners that look alike and have a depth in one of the maps.
#include <optional>
#include <vector>

#include "edgevo/alignment/edge_match.h"
#include "edgevo/places/place_match.h"

namespace edgevo {

/// Finds the point of a cloud that is seen nearest to a pixel.
class NearestPoint {
 public:
  /// `points` must outlive this. Pixels are those of `pinhole`; up to `radius` away.
  NearestPoint(const Pinhole& pinhole, const std::vector<CloudPoint>& points, float radius);
  /// The nearest point; null if there is none within the radius.
  const CloudPoint* find(const Eigen::Vector2f& px) const;

 private:
  const std::vector<CloudPoint>* points_;
  float radius_, cell_;
  int columns_, rows_;
  std::vector<std::vector<int>> cells_;
};

/// A pose by corners.
struct CornerPose {
  /// From the camera of view a to that of view b, in the unit of map a.
  SE3 T_b_a;
};
/// The pose that most corners agree with, by depths in map a. Notes how many in the evidence.
std::optional<CornerPose> pose_by_corners(const Pinhole& pinhole, const PlaceView& a, const RememberedView& b,
                                          PlaceEvidence* evidence);

}  // namespace edgevo
