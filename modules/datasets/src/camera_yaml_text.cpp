// SPDX-License-Identifier: BSD-3-Clause
#include <charconv>
#include <sstream>

#include "edgevo/datasets/camera_file.h"

namespace edgevo {
namespace {

// The fewest digits that are read back as the same double, with a decimal point, without which OpenCV reads
// an integer.
std::string real(double value) {
  char buffer[32];
  std::string text(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

// The layout of ROS, and `dt` for OpenCV: with it OpenCV reads a matrix even without its own tag, which other
// readers reject.
std::string matrix(const char* key, int rows, int cols, const std::vector<double>& data) {
  std::string numbers;
  for (const double value : data) numbers += (numbers.empty() ? "" : ", ") + real(value);
  return std::string(key) + ":\n  rows: " + std::to_string(rows) + "\n  cols: " + std::to_string(cols) +
         "\n  dt: d\n  data: [" + numbers + "]\n";
}

std::string commented(const std::string& comment) {
  std::istringstream lines(comment);
  std::string text;
  for (std::string line; std::getline(lines, line);) text += "# " + line + '\n';
  return text;
}

// The angles in degrees, then the position in metres.
std::string mount_line(const CameraMount& m) {
  std::string text = "mount: [";
  for (const double value : {m.roll_deg, m.pitch_deg, m.yaw_deg}) text += real(value) + ", ";
  return text + real(m.position.x()) + ", " + real(m.position.y()) + ", " + real(m.position.z()) + "]\n";
}

}  // namespace

std::string camera_yaml(const Camera& camera, const std::string& comment,
                        const std::optional<CameraMount>& mount) {
  const Pinhole p = camera.pinhole();
  const Distortion d = camera.distortion();
  // OpenCV insists on the directive; libfyaml, under MRPT, on a version that it knows: 1.2 suits both, 1.0
  // does not.
  return "%YAML 1.2\n---\n" + commented(comment) + "image_width: " + std::to_string(p.width) +
         "\nimage_height: " + std::to_string(p.height) + "\ncamera_name: camera\n" +
         matrix("camera_matrix", 3, 3, {p.fx, 0, p.cx, 0, p.fy, p.cy, 0, 0, 1}) +
         "distortion_model: plumb_bob\n" +
         matrix("distortion_coefficients", 1, 5, {d.k1, d.k2, d.p1, d.p2, d.k3}) +
         matrix("rectification_matrix", 3, 3, {1, 0, 0, 0, 1, 0, 0, 0, 1}) +
         matrix("projection_matrix", 3, 4, {p.fx, 0, p.cx, 0, 0, p.fy, p.cy, 0, 0, 0, 1, 0}) +
         (mount ? mount_line(*mount) : "");
}

}  // namespace edgevo
