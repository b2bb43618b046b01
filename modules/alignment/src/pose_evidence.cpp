// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/alignment/pose_evidence.h"

#include "edgevo/alignment/edge_match.h"
#include "edgevo/core/robust.h"

namespace edgevo {
namespace {

// Calls f(point, its projection) for every point in view on the finest level.
template <class F>
void for_visible(const PyramidLevel& level, const ReferenceCloud& cloud, const SE3& T_cur_ref, const F& f) {
  const Eigen::Matrix3d R = T_cur_ref.R();
  const Eigen::Vector3d t = T_cur_ref.translation();
  for (const CloudPoint& point : cloud.points) {
    const Projection p = project(level.pinhole, R, t, point.ray, point.idepth);
    if (p.valid && level.pinhole.contains(p.px, kEdgelessBorder)) f(point, p);
  }
}

}  // namespace

PoseEvidence weigh_evidence(const FramePyramid& current, const ReferenceCloud& cloud, const SE3& T_cur_ref,
                            const AlignmentParams& params) {
  const PyramidLevel& level = current.finest();
  PoseEvidence evidence;
  double inlier_weight = 0;
  for_visible(level, cloud, T_cur_ref, [&](const CloudPoint& point, const Projection& p) {
    const double w = depth_weight(projection_jacobian(level.pinhole, p.Y), T_cur_ref.translation(),
                                  point.normal.cast<double>(), point.idepth_sigma);
    evidence.weight += w;
    const EdgeMatch match = match_edge(level, p.px, point.normal, params);
    if (match.found && std::abs(match.residual_px) < params.huber_px) inlier_weight += w;
  });
  if (evidence.weight > 0) evidence.inlier_share = inlier_weight / evidence.weight;
  return evidence;
}

std::vector<PoseEquation> pose_equations(const FramePyramid& current, const ReferenceCloud& cloud,
                                         const SE3& T_cur_ref, const AlignmentParams& params) {
  const PyramidLevel& level = current.finest();
  const Eigen::Vector2d middle = 0.5 * Eigen::Vector2d(level.pinhole.width - 1, level.pinhole.height - 1);
  std::vector<PoseEquation> equations;
  for_visible(level, cloud, T_cur_ref, [&](const CloudPoint& point, const Projection& p) {
    const EdgeMatch match = match_edge(level, p.px, point.normal, params);
    if (!match.found) return;
    PoseEquation e;
    e.jacobian = match.normal.transpose() * pose_jacobian(level.pinhole, p.Y, point.idepth);
    e.residual_px = match.residual_px;
    e.weight = huber_weight(match.residual_px, params.huber_px) *
               depth_weight(projection_jacobian(level.pinhole, p.Y), T_cur_ref.translation(), match.normal,
                            point.idepth_sigma);
    e.edge = match.chain;
    e.normal = match.normal;
    e.at = (p.px - middle) * (2.0 / level.pinhole.width);
    equations.push_back(e);
  });
  return equations;
}

}  // namespace edgevo
