// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/camera_file.h"
#include "lens_text.h"
#include "yaml_text.h"

namespace edgevo {
namespace {

// The layout of ROS, and `dt` for OpenCV: with it OpenCV reads a matrix even without its own tag, which other
// readers reject.
std::string matrix(const char* key, int rows, int cols, const std::vector<double>& data) {
  return std::string(key) + ":\n  rows: " + std::to_string(rows) + "\n  cols: " + std::to_string(cols) +
         "\n  dt: d\n  data: " + yaml_list(data) + "\n";
}

// The angles in degrees, then the position in metres.
std::string mount_line(const CameraMount& m) {
  std::string text = "mount: [";
  for (const double value : {m.roll_deg, m.pitch_deg, m.yaw_deg}) text += yaml_real(value) + ", ";
  return text + yaml_real(m.position.x()) + ", " + yaml_real(m.position.y()) + ", " +
         yaml_real(m.position.z()) + "]\n";
}

// The lens under the names of ROS, which calls a pinhole a plumb-bob lens without distortion.
StatedLens ros_lens(const Camera& camera) {
  StatedLens lens = stated_lens(camera.model);
  if (lens.kind != LensKind::kPinhole) return lens;
  lens.kind = LensKind::kPlumbBob;
  lens.coefficients.assign(5, 0.0);
  return lens;
}

}  // namespace

std::string camera_yaml(const Camera& camera, const std::string& comment,
                        const std::optional<CameraMount>& mount) {
  const Pinhole p = camera.pinhole();
  const StatedLens lens = ros_lens(camera);
  const Intrinsics& i = lens.intrinsics;
  // OpenCV insists on the directive; libfyaml, under MRPT, on a version that it knows: 1.2 suits both, 1.0
  // does not.
  return "%YAML 1.2\n---\n" + yaml_comment(comment) + "image_width: " + std::to_string(p.width) +
         "\nimage_height: " + std::to_string(p.height) + "\ncamera_name: camera\n" +
         matrix("camera_matrix", 3, 3, {i.fx, 0, i.cx, 0, i.fy, i.cy, 0, 0, 1}) +
         "distortion_model: " + name_of(lens.kind) + "\n" +
         matrix("distortion_coefficients", 1, int(lens.coefficients.size()), lens.coefficients) +
         matrix("rectification_matrix", 3, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1}) +
         matrix("projection_matrix", 3, 4, {p.fx, 0, p.cx, 0, 0, p.fy, p.cy, 0, 0, 0, 1, 0}) +
         (mount ? mount_line(*mount) : "");
}

}  // namespace edgevo
