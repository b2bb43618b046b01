// Virtual KITTI as a sequence of images; depth and poses are for the study (edgevo/datasets/virtual_kitti.h).
#include "edgevo/datasets/virtual_kitti.h"
#include "sequence.h"

namespace edgevo {

Sequence read_virtual_kitti_layout(const SourceOptions& options) {
  VirtualKitti v = read_virtual_kitti(options);
  Sequence sequence;
  sequence.kind = "Virtual KITTI " + v.release;
  sequence.images = std::move(v.images);
  sequence.times = std::move(v.times);
  sequence.camera = v.camera;
  if (!v.camera_name.empty()) sequence.details.emplace_back("camera folder", v.camera_name);
  if (!v.poses_path.empty()) sequence.details.emplace_back("ground truth", v.poses_path + " (Virtual KITTI format)");
  return sequence;
}

}  // namespace edgevo
