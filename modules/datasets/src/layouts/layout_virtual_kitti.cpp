// SPDX-License-Identifier: BSD-3-Clause
// Virtual KITTI as a sequence of images; depth and poses are for the study (edgevo/datasets/virtual_kitti.h).
#include "edgevo/datasets/virtual_kitti.h"
#include "layout.h"
#include "tum_text.h"

namespace edgevo {
namespace {

Sequence read_virtual_kitti_layout(const SourceOptions& options) {
  VirtualKitti v = read_virtual_kitti(options);
  Sequence sequence;
  sequence.kind = "Virtual KITTI " + v.release;
  sequence.images = std::move(v.images);
  sequence.times = std::move(v.times);
  sequence.camera = v.camera;
  sequence.decisions = std::move(v.decisions);
  if (!v.camera_name.empty()) sequence.details.emplace_back("camera folder", v.camera_name);
  if (!v.poses_path.empty())
    sequence.details.emplace_back("ground truth", v.poses_path + " (Virtual KITTI format)");
  return sequence;
}

std::string virtual_kitti_ground_truth(const SourceOptions& options) {
  const VirtualKitti sequence = read_virtual_kitti(options);
  if (sequence.T_world_cam.empty()) return {};
  std::string text = "# Virtual KITTI ground truth as TUM: timestamp tx ty tz qx qy qz qw (T_world_cam)\n";
  for (size_t i = 0; i < sequence.T_world_cam.size(); ++i)
    append_pose(&text, sequence.times[i], sequence.T_world_cam[i]);
  return text;
}

}  // namespace

Layout virtual_kitti_layout() {
  return {is_virtual_kitti, read_virtual_kitti_layout, true, virtual_kitti_ground_truth, false, false};
}

}  // namespace edgevo
