#include <cmath>

#include "edgevo/alignment/projection.h"
#include "edgevo/mapping/mapper.h"

namespace edgevo {

KeyframeDecision decide_keyframe(const Pinhole& pinhole, const ReferenceCloud& cloud, const SE3& T_cam_ref,
                                 int frames_since_keyframe, const KeyframeParams& params) {
  constexpr double kReferenceWidth = 1241;  // the pixel thresholds are stated at this width
  KeyframeDecision d;
  const Eigen::Matrix3d R = T_cam_ref.R();
  const Eigen::Vector3d t = T_cam_ref.translation();
  double square = 0;
  int counted = 0, in_view = 0;
  for (const CloudPoint& p : cloud.points) {
    const Projection moved = project(pinhole, R, t, p.ray, p.idepth);
    if (moved.valid && pinhole.contains(moved.px)) ++in_view;
    const Projection turned = project(pinhole, R, Eigen::Vector3d::Zero(), p.ray, p.idepth);
    if (!moved.valid || !turned.valid) continue;
    square += (moved.px - turned.px).squaredNorm();
    ++counted;
  }
  if (counted == 0) return d;
  const double scale = kReferenceWidth / pinhole.width;
  d.flow_px = std::sqrt(square / counted);
  d.view_share = double(in_view) / double(cloud.points.size());
  const double flow = d.flow_px * scale;
  // At a standstill or in a pure rotation a keyframe brings matches but no depth: there is one only to follow the rotation.
  d.needed = flow > params.flow_px || d.view_share < params.min_turn_share ||
             (flow > params.min_flow_px &&
              (d.view_share < params.min_view_share || frames_since_keyframe >= params.max_frames));
  return d;
}

}  // namespace edgevo
