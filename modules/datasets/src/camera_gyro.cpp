// SPDX-License-Identifier: BSD-3-Clause
// How a gyro sits next to a camera, in the file of the camera.
#include <cmath>

#include "camera_yaml.h"
#include "edgevo/core/angle.h"
#include "edgevo/core/error.h"
#include "edgevo/core/rotation_vector.h"
#include "edgevo/datasets/camera_file.h"
#include "yaml_text.h"

namespace edgevo {
namespace {

// Of a rotation and an offset that a run found: several times what it states.
constexpr double kRotationSigma = rad(0.5), kOffsetSigma = 0.005;

}  // namespace

std::optional<GyroModel> parse_yaml_gyro(const std::string& text, const std::string& where) {
  const std::vector<YamlValues> documents = parse_yaml_documents(text, where);
  if (documents.empty() || !documents.front().count("gyro")) return std::nullopt;
  const std::vector<double> values = yaml_numbers(documents.front(), {"gyro"}, where);
  const bool is_right = values.size() == 4 && std::abs(values[3]) <= kMostGyroOffsetS &&
                        Eigen::Vector3d(values[0], values[1], values[2]).norm() < 200;
  if (!is_right)
    throw InputError(where + ": gyro", "is not a rotation in degrees and an offset in seconds, up to 0.2",
                     "write gyro: [x, y, z, offset], or remove it: a run finds it");
  GyroModel gyro = gyro_before_use();
  gyro.R_cam_gyro = rotation_of(rad(1) * Eigen::Vector3d(values[0], values[1], values[2]));
  gyro.offset_s = values[3];
  gyro.covariance.diagonal().head<3>().setConstant(kRotationSigma * kRotationSigma);
  gyro.covariance(kGyroOffset, kGyroOffset) = kOffsetSigma * kOffsetSigma;
  return gyro;
}

std::string gyro_yaml(const GyroModel& gyro) {
  const Eigen::Vector3d turn = rotation_vector(gyro.R_cam_gyro);
  std::string text = "gyro: [";
  for (const double angle : turn) text += yaml_real(deg(angle)) + ", ";
  return text + yaml_real(gyro.offset_s) + "]\n";
}

}  // namespace edgevo
