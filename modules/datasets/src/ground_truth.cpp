#include "edgevo/datasets/ground_truth.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string_view>
#include <vector>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/datasets/virtual_kitti.h"
#include "euroc.h"
#include "kitti.h"
#include "sequence.h"
#include "text_file.h"

namespace edgevo {
namespace {

void append_pose(std::string* text, Timestamp t, const SE3& T_world_cam) {
  *text += to_string(t);
  for (const double v :
       {T_world_cam.translation().x(), T_world_cam.translation().y(), T_world_cam.translation().z()})
    *text += " " + fixed(v, 9);
  const Eigen::Quaterniond& q = T_world_cam.rotation();
  for (const double v : {q.x(), q.y(), q.z(), q.w()}) *text += " " + fixed(v, 9);
  *text += "\n";
}

// One pose of camera 0 a line, 3x4, row by row. The rectified cameras differ by a shift along x: P[3] = -fx
// x_cam.
std::string convert_kitti(const SourceOptions& options) {
  const std::string poses = kitti_poses_path(options.path);
  if (poses.empty()) return {};
  const std::string times_path = (std::filesystem::path(options.path) / "times.txt").string();
  const auto times = read_times(times_path);
  const auto lines = split_lines(read_text_file(poses), poses);
  if (lines.size() != times.size())
    throw InputError(poses,
                     std::to_string(lines.size()) + " poses for " + std::to_string(times.size()) + " times",
                     "restore the file");
  const auto P = read_kitti_projection(options, kitti_camera_folder(options));
  if (!(P[0] > 0))
    throw InputError(options.path, "the focal length in calib.txt is not positive", "restore the file");
  const SE3 T_cam0_cam(Eigen::Quaterniond::Identity(), Eigen::Vector3d(-P[3] / P[0], 0, 0));
  std::string text = "# KITTI ground truth as TUM: timestamp tx ty tz qx qy qz qw (T_world_cam)\n";
  for (size_t i = 0; i < lines.size(); ++i) {
    const auto m = parse_numbers(lines[i], 12, "a 3x4 matrix, row by row");
    Eigen::Matrix3d R;
    R << m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10];
    append_pose(&text, times[i], SE3(R, Eigen::Vector3d(m[3], m[7], m[11])) * T_cam0_cam);
  }
  return text;
}

// `ns, px, py, pz, qw, qx, qy, qz, ...` of the body a line.
std::string convert_euroc(const SourceOptions& options) {
  const std::string path = euroc_ground_truth_path(options.path);
  if (path.empty()) return {};
  const SE3 T_body_cam = read_euroc_T_body_cam(euroc_camera_folder(options));
  std::string text = "# EuRoC ground truth as TUM: timestamp tx ty tz qx qy qz qw (T_world_cam)\n";
  for (const TextLine& line : split_lines(read_text_file(path), path)) {
    const auto fields = split_fields(line.text, ',');
    if (fields.size() < 8)
      throw InputError(line.where, "is not a time, a position and a quaternion", "restore the file");
    double v[7];
    for (int i = 0; i < 7; ++i) v[i] = parse_number(fields[size_t(i) + 1], line.where);
    const Eigen::Quaterniond q(v[3], v[4], v[5], v[6]);
    if (!(std::abs(q.norm() - 1) < 0.01))
      throw InputError(line.where, "the quaternion is not of unit length", "restore the file");
    append_pose(&text, parse_nanoseconds(fields[0], line.where),
                SE3(q, Eigen::Vector3d(v[0], v[1], v[2])) * T_body_cam);
  }
  return text;
}

std::string convert_virtual_kitti(const SourceOptions& options) {
  const VirtualKitti sequence = read_virtual_kitti(options);
  if (sequence.T_world_cam.empty()) return {};
  std::string text = "# Virtual KITTI ground truth as TUM: timestamp tx ty tz qx qy qz qw (T_world_cam)\n";
  for (size_t i = 0; i < sequence.T_world_cam.size(); ++i) append_pose(&text, sequence.times[i], sequence.T_world_cam[i]);
  return text;
}

}  // namespace

std::string ground_truth_tum(const SourceOptions& options, const ImageSource& source) {
  if (const std::string path = source.ground_truth_path(); !path.empty()) return read_text_file(path);
  if (source.kind() == "KITTI odometry") return convert_kitti(options);
  if (source.kind() == "EuRoC") return convert_euroc(options);
  if (source.kind().rfind("Virtual KITTI", 0) == 0) return convert_virtual_kitti(options);
  return {};
}

std::string played_backward(const std::string& tum, Timestamp first, Timestamp last) {
  std::vector<std::string> poses;
  std::istringstream lines(tum);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    const size_t end = line.find(' ');
    Timestamp t;
    if (!parse_seconds(std::string_view(line).substr(0, end), &t))
      throw InputError("ground truth", "has no time in '" + line + "'", "write lines `t tx ty tz qx qy qz qw`");
    t.ticks = first.ticks + last.ticks - t.ticks;
    if (t.ticks >= 0) poses.push_back(to_string(t) + line.substr(std::min(end, line.size())) + '\n');
  }
  std::string text = "# played backward: t tx ty tz qx qy qz qw\n";
  for (auto pose = poses.rbegin(); pose != poses.rend(); ++pose) text += *pose;
  return text;
}

}  // namespace edgevo
