// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/segmentation/stationary_detector.h"

#include <cmath>
#include <vector>

#include "edgevo/alignment/pose_evidence.h"
#include "edgevo/alignment/projection.h"

namespace edgevo {
namespace {

constexpr size_t kMinStillPoints = 30;  // of known depth, that stand still
constexpr double kMovedPx = 1;          // across the edge: still edges have moved less (StillCells)
constexpr double kExplained = 0.6;      // share of what stands still, by a camera that stands

// Points of known depth in the part that stands still, as a camera at T_cur_ref sees them.
std::vector<size_t> points_in(const StillCells& cells, const Pinhole& camera, const ReferenceCloud& cloud,
                              const SE3& T_cur_ref) {
  const Eigen::Matrix3d R = T_cur_ref.R();
  std::vector<size_t> inside;
  for (size_t i = 0; i < cloud.points.size(); ++i) {
    const CloudPoint& c = cloud.points[i];
    if (c.host_keyframe < 0) continue;  // its depth is a guess
    const Projection p = project(camera, R, T_cur_ref.translation(), c.ray, c.idepth);
    if (p.valid && camera.contains(p.px) && cells.contain(p.px.x() / camera.width, p.px.y() / camera.height))
      inside.push_back(i);
  }
  return inside;
}

// Whether another pose puts most of the points elsewhere, across their edges.
bool moves(const Pinhole& camera, const std::vector<CloudPoint>& points, const SE3& T_before,
           const SE3& T_after) {
  if (!T_after.is_finite()) return true;
  size_t moved = 0;
  const Eigen::Matrix3d R_before = T_before.R(), R_after = T_after.R();
  for (const CloudPoint& c : points) {
    const Projection before = project(camera, R_before, T_before.translation(), c.ray, c.idepth),
                     after = project(camera, R_after, T_after.translation(), c.ray, c.idepth);
    moved += !after.valid || std::abs(c.normal.cast<double>().dot(after.px - before.px)) > kMovedPx;
  }
  return 2 * moved > points.size();
}

}  // namespace

std::shared_ptr<const Reference> StationaryDetector::still_part(
    const FramePyramid& frame, const StillCells& cells, const std::shared_ptr<const Reference>& reference,
    const SE3& T_cur_ref, const AlignmentParams& params) const {
  if (cells.empty() || !T_standing_ref_ || !was_seen_to_stand_) return nullptr;
  const std::vector<size_t> inside =
      points_in(cells, frame.finest().pinhole, reference->cloud, *T_standing_ref_);
  if (inside.size() < kMinStillPoints) return nullptr;
  auto still = std::make_shared<Reference>(*reference);
  still->cloud = part_of(reference->cloud, inside);
  still->known_points = int(inside.size());
  const bool moves_it = moves(frame.finest().pinhole, still->cloud.points, *T_standing_ref_, T_cur_ref);
  const auto explained = [&](const SE3& T) {
    return T.is_finite() ? weigh_evidence(frame, still->cloud, T, params).inlier_share : 0;
  };
  const double standing = explained(*T_standing_ref_);
  if (standing < kExplained || (moves_it && explained(T_cur_ref) >= standing)) return nullptr;
  return still;
}

bool StationaryDetector::stands(const StillCells& cells, const Pinhole& camera, const ReferenceCloud& cloud,
                                const SE3& T_cur_ref, const Eigen::Vector3d& typical_step) const {
  if (cells.empty() || !T_standing_ref_) return false;
  const std::vector<size_t> inside = points_in(cells, camera, cloud, *T_standing_ref_);
  if (inside.size() < kMinStillPoints) return false;
  const std::vector<CloudPoint> points = part_of(cloud, inside).points;
  const SE3 T_usual(Eigen::Quaterniond::Identity(), typical_step);
  return !moves(camera, points, *T_standing_ref_, T_cur_ref) &&
         moves(camera, points, *T_standing_ref_, T_usual * *T_standing_ref_);
}

void StationaryDetector::follow(const StillCells& cells, const SE3& T_cur_ref, bool stands) {
  if (cells.empty() || !T_standing_ref_) {
    T_standing_ref_ = T_cur_ref;
    was_seen_to_stand_ = false;
  }
  was_seen_to_stand_ |= stands;
}

void StationaryDetector::change_reference(const SE3& T_old_new) {
  if (T_standing_ref_) *T_standing_ref_ = *T_standing_ref_ * T_old_new;
}

}  // namespace edgevo
