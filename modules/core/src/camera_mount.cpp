// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/camera_mount.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "edgevo/core/angle.h"
#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/records.h"

namespace edgevo {
namespace {
constexpr double kLargestAngle = 360;      // degrees
constexpr double kLargestPosition = 1000;  // metres: more is a slip, such as millimetres
constexpr double kVertical = 1 - 1e-12;    // sine of a pitch beyond which roll and yaw are one angle
constexpr const char* kRemedy =
    "give roll,pitch,yaw in degrees, and x,y,z in metres if known: 0,20,0 is a camera 20 degrees down";

Eigen::AngleAxisd about(int axis, double degrees) { return {rad(degrees), Eigen::Vector3d::Unit(axis)}; }

double number(std::string text, const std::string& where) {
  text.erase(0, text.find_first_not_of(' '));
  text.erase(text.find_last_not_of(' ') + 1);
  double value = 0;
  const char* const end = text.data() + text.size();
  const char* const begin = text.data() + (!text.empty() && text[0] == '+');
  const auto read = std::from_chars(begin, end, value);
  if (read.ec != std::errc() || read.ptr != end)
    throw InputError(where, "'" + text + "' is not a number", kRemedy);
  return value;
}

std::string turned(double degrees, const char* positive, const char* negative) {
  return fixed(std::abs(degrees), 1) + " " + (degrees < 0 ? negative : positive);
}

}  // namespace

SE3 T_vehicle_cam(const CameraMount& m) {
  const Eigen::Quaterniond body = about(2, m.yaw_deg) * about(1, m.pitch_deg) * about(0, m.roll_deg);
  return {body * T_zup_world().rotation(), m.position};
}

CameraMount camera_mount(const SE3& T) {
  const Eigen::Matrix3d R = T.R() * T_zup_world().R().transpose();
  CameraMount m;
  m.position = T.translation();
  const double down = std::clamp(-R(2, 0), -1.0, 1.0);
  m.pitch_deg = deg(std::asin(down));
  if (std::abs(down) > kVertical) {
    m.yaw_deg = deg(std::atan2(-R(0, 1), R(1, 1)));
    return m;
  }
  m.roll_deg = deg(std::atan2(R(2, 1), R(2, 2)));
  m.yaw_deg = deg(std::atan2(R(1, 0), R(0, 0)));
  return m;
}

CameraMount camera_mount(const std::vector<double>& v, const std::string& where) {
  if (v.size() != 3 && v.size() != 6)
    throw InputError(where, "holds " + std::to_string(v.size()) + " numbers, not 3 or 6", kRemedy);
  for (size_t i = 0; i < v.size(); ++i)
    if (!(std::abs(v[i]) <= (i < 3 ? kLargestAngle : kLargestPosition)))
      throw InputError(where, i < 3 ? "an angle is beyond 360 degrees" : "a position is beyond a kilometre",
                       kRemedy);
  CameraMount m{v[0], v[1], v[2]};
  if (v.size() == 6) m.position = {v[3], v[4], v[5]};
  return m;
}

CameraMount parse_camera_mount(const std::string& text, const std::string& where) {
  std::vector<double> numbers;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t comma = std::min(text.find(',', begin), text.size());
    numbers.push_back(number(text.substr(begin, comma - begin), where));
    begin = comma + 1;
  }
  return camera_mount(numbers, where);
}

std::string describe(const CameraMount& m) {
  return "looks " + turned(m.pitch_deg, "degrees down", "degrees up") + " and " +
         turned(m.yaw_deg, "to the left", "to the right") + ", turned " +
         turned(m.roll_deg, "clockwise", "counter-clockwise");
}

}  // namespace edgevo
