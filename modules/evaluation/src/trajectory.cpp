// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/evaluation/trajectory.h"

#include <Eigen/LU>
#include <array>
#include <charconv>
#include <cmath>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"

namespace edgevo {
namespace {

constexpr size_t kTumFields = 8, kKittiFields = 12;
// Files round to a few digits; anything further from a rotation than this is not one.
constexpr double kRotationTolerance = 0.02;

using Fields = std::vector<std::string_view>;

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const size_t end = text.find('\n');
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

Fields split_fields(std::string_view line) {
  constexpr std::string_view kBlanks = " \t\r";
  Fields fields;
  size_t begin = 0;
  while ((begin = line.find_first_not_of(kBlanks, begin)) != std::string_view::npos) {
    const size_t end = std::min(line.find_first_of(kBlanks, begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    begin = end;
  }
  return fields;
}

// A field made fit for an error message: short and without control characters.
std::string shown(std::string_view field) {
  std::string s(field.substr(0, 24));
  for (char& c : s)
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e) c = '?';
  return "'" + s + "'";
}

double to_number(std::string_view field, const std::string& where) {
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size())
    throw InputError(where, shown(field) + " is not a number", "correct or remove the line");
  if (!std::isfinite(value)) throw InputError(where, shown(field) + " is not finite", "remove unknown poses");
  return value;
}

StampedPose parse_tum(const Fields& f, const std::string& where) {
  StampedPose pose;
  if (!parse_seconds(f[0], &pose.time))
    throw InputError(where, "time " + shown(f[0]) + " is not a number of seconds",
                     "correct or remove the line");
  std::array<double, 7> v{};
  for (size_t i = 0; i < v.size(); ++i) v[i] = to_number(f[i + 1], where);
  const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
  if (!(std::abs(q.norm() - 1.0) < kRotationTolerance))
    throw InputError(where, "qx qy qz qw is not a unit quaternion", "the order is t tx ty tz qx qy qz qw");
  pose.T_world_cam = SE3(q, Eigen::Vector3d(v[0], v[1], v[2]));
  return pose;
}

StampedPose parse_kitti(const Fields& f, int row, const std::string& where) {
  Eigen::Matrix<double, 3, 4, Eigen::RowMajor> M;
  for (size_t i = 0; i < kKittiFields; ++i) M.data()[i] = to_number(f[i], where);
  const Eigen::Matrix3d R = M.leftCols<3>();
  const bool orthonormal = (R.transpose() * R - Eigen::Matrix3d::Identity()).norm() < kRotationTolerance;
  if (!orthonormal || R.determinant() < 0)
    throw InputError(where, "the 3x3 part is not a rotation", "a KITTI line is r11 r12 r13 tx r21 ... tz");
  return {Timestamp{row * Timestamp::kTicksPerSecond}, SE3(R, M.col(3))};
}

}  // namespace

std::string_view to_string(TrajectoryFormat format) {
  return format == TrajectoryFormat::kTum ? "TUM" : "KITTI";
}

Trajectory parse_trajectory(std::string_view text, const std::string& where) {
  Trajectory trajectory{where, TrajectoryFormat::kTum, {}};
  size_t expected = 0;
  int number = 0;
  for (std::string_view line : split_lines(text)) {
    const std::string at = where + ":" + std::to_string(++number);
    const Fields fields = split_fields(line);
    if (fields.empty() || fields[0].front() == '#') continue;
    if (expected == 0) {
      if (fields.size() != kTumFields && fields.size() != kKittiFields)
        throw InputError(at, std::to_string(fields.size()) + " fields",
                         "a TUM line has 8 (t tx ty tz qx qy qz qw), a KITTI line 12");
      expected = fields.size();
      trajectory.format = expected == kTumFields ? TrajectoryFormat::kTum : TrajectoryFormat::kKitti;
    }
    if (fields.size() != expected)
      throw InputError(
          at,
          std::to_string(fields.size()) + " fields where the lines before have " + std::to_string(expected),
          "correct or remove the line");
    const StampedPose pose = trajectory.format == TrajectoryFormat::kTum
                                 ? parse_tum(fields, at)
                                 : parse_kitti(fields, int(trajectory.poses.size()), at);
    if (!trajectory.poses.empty() && pose.time == trajectory.poses.back().time &&
        pose.time.ticks % Timestamp::kTicksPerSecond == 0)
      throw InputError(at, "time " + to_string(pose.time) + " again: the times have lost their digits",
                       "write them with six and more after the point (%.6f)");
    if (!trajectory.poses.empty() && pose.time <= trajectory.poses.back().time)
      throw InputError(
          at,
          "time " + to_string(pose.time) + " does not come after " + to_string(trajectory.poses.back().time),
          "sort the lines and keep one per time");
    trajectory.poses.push_back(pose);
  }
  if (trajectory.poses.empty())
    throw InputError(where, "contains no pose", "give a trajectory with lines t tx ty tz qx qy qz qw");
  return trajectory;
}

Trajectory trajectory_of(const Run& run) {
  Trajectory trajectory{"this run", TrajectoryFormat::kTum, {}};
  for (const FrameRecord& frame : run.frames)
    if (frame.T_world_cam && frame.T_world_cam->is_finite())
      trajectory.poses.push_back({frame.time, *frame.T_world_cam});
  return trajectory;
}

Trajectory read_trajectory(const std::string& path) {
  return parse_trajectory(read_text(path, "give the path of a TUM or KITTI trajectory file"), path);
}

}  // namespace edgevo
