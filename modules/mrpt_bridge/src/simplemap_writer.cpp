// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/simplemap_writer.h"

#include <mrpt/maps/CSimpleMap.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>

#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/edge_scan.h"
#include "object_file.h"

namespace edgevo {

void write_simplemap(const Run& run, const PointFilter& filter, const std::string& path) {
  const SE3 T_map = T_map_world(run);
  mrpt::maps::CSimpleMap map;
  for (const KeyframeRecord& keyframe : run.keyframes) {
    const SE3 T_map_cam = T_map * keyframe.T_world_cam;
    if (!T_map_cam.is_finite()) continue;
    const auto scan = make_edge_scan(keyframe, run.pinhole, filter, SE3());
    if (scan->points3D_x.empty()) continue;
    auto observations = mrpt::obs::CSensoryFrame::Create();
    observations->insert(scan);
    const mrpt::poses::CPose3DPDFGaussian pose(to_mrpt(T_map_cam), mrpt::math::CMatrixDouble66::Zero());
    map.insert(pose, *observations);
  }
  ObjectFile out(path);
  out.write(map);
  out.close();
}

}  // namespace edgevo
