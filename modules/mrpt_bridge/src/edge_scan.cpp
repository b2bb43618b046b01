// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/edge_scan.h"

#include <algorithm>
#include <cmath>

#include "edgevo/mrpt_bridge/conversions.h"

namespace edgevo {
namespace {

uint16_t pixel_index(float x) { return uint16_t(std::clamp(std::lround(x), 0l, 65535l)); }

}  // namespace

mrpt::obs::CObservation3DRangeScan::Ptr make_edge_scan(const KeyframeRecord& keyframe, const Pinhole& pinhole,
                                                       const PointFilter& filter, const SE3& T_F_cam) {
  auto scan = mrpt::obs::CObservation3DRangeScan::Create();
  scan->timestamp = to_mrpt(keyframe.time);
  scan->sensorLabel = "EDGE_VO_POINTS";
  scan->cameraParams = to_mrpt(Camera{pinhole, {}});
  scan->hasPoints3D = true;
  double farthest = 0;
  const auto add = [&](const auto& p) {
    const Eigen::Vector3d point = T_F_cam * point_in_camera(pinhole, p);
    scan->points3D_x.push_back(float(point.x()));
    scan->points3D_y.push_back(float(point.y()));
    scan->points3D_z.push_back(float(point.z()));
    scan->points3D_idxs_x.push_back(pixel_index(p.px.x()));
    scan->points3D_idxs_y.push_back(pixel_index(p.px.y()));
    farthest = std::max(farthest, point.norm());
  };
  for (const EdgePoint& p : keyframe.points)
    if (filter.keeps(p)) add(p);
  for (const EdgeLine& line : keyframe.lines)
    for (const EdgeVertex& v : line.vertices) add(v);
  scan->maxRange = float(farthest);
  return scan;
}

}  // namespace edgevo
