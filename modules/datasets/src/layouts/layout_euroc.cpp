// SPDX-License-Identifier: BSD-3-Clause
// EuRoC (ASL): mav0/camN/{data.csv, data/, sensor.yaml}, mav0/state_groundtruth_estimate0/data.csv; times in
// ns.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "assumed_camera.h"
#include "camera_yaml.h"
#include "edgevo/core/error.h"
#include "layout.h"
#include "text_file.h"
#include "tum_text.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

constexpr double kRotationError = 1e-3;    // of R R^T from the identity: allows for files with few digits
constexpr double kQuaternionError = 0.01;  // of its norm from 1: allows for files with few digits

// The user may name the sequence or its mav0/.
fs::path mav_folder(const std::string& folder) {
  std::error_code ignored;
  const fs::path inside = fs::path(folder) / "mav0";
  return fs::is_directory(inside, ignored) ? inside : fs::path(folder);
}

bool is_euroc_layout(const std::string& folder) {
  std::error_code ignored;
  return fs::is_directory(mav_folder(folder) / "cam0", ignored);
}

// Names of the cameras, those with a list of images, in order.
std::vector<std::string> euroc_cameras(const fs::path& mav) {
  std::vector<std::string> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(mav, ignored))
    if (!existing((entry.path() / "data.csv").string()).empty() &&
        entry.path().filename().string().rfind("cam", 0) == 0)
      found.push_back(entry.path().filename().string());
  std::sort(found.begin(), found.end());
  return found;
}

// ".../mav0/cam0" of the chosen camera.
std::string euroc_camera_folder(const SourceOptions& options) {
  const std::string name = options.sensor_label.empty() ? "cam0" : options.sensor_label;
  const fs::path mav = mav_folder(options.path), list = mav / name / "data.csv";
  if (!existing(list.string()).empty()) return (mav / name).string();
  const std::vector<std::string> found = euroc_cameras(mav);
  if (found.empty())
    throw InputError(list.string(), "is missing, which lists the images and their times",
                     "restore it, or give the folder of the images with --camera and --fps");
  std::string all;
  for (const std::string& camera : found) all += (all.empty() ? "" : ", ") + camera;
  throw InputError(options.path, "no camera '" + name + "'; there are " + all,
                   "did you mean --sensor " + nearest_name(name, found) + "?");
}

// Mount of the camera in the body frame (the IMU's; not x forward, z up): T_BS of its sensor.yaml.
SE3 read_euroc_T_body_cam(const std::string& camera_folder) {
  const std::string path = (fs::path(camera_folder) / "sensor.yaml").string();
  const auto T = yaml_numbers(parse_flat_yaml(read_text_file(path), path), {"t_bs.data", "t_bs"}, path);
  if (T.size() != 16) throw InputError(path, "T_BS is not a 4x4 matrix", "restore the file");
  Eigen::Matrix3d R;
  R << T[0], T[1], T[2], T[4], T[5], T[6], T[8], T[9], T[10];
  if ((R * R.transpose() - Eigen::Matrix3d::Identity()).norm() > kRotationError || R.determinant() < 0)
    throw InputError(path, "T_BS is not a rigid motion", "restore the file");
  return {R, Eigen::Vector3d(T[3], T[7], T[11])};
}

// ".../mav0/state_groundtruth_estimate0/data.csv"; empty if there is none.
std::string euroc_ground_truth_path(const std::string& folder) {
  return existing((mav_folder(folder) / "state_groundtruth_estimate0" / "data.csv").string());
}

Sequence read_euroc_layout(const SourceOptions& options) {
  const fs::path camera_folder = euroc_camera_folder(options);
  const std::string list = (camera_folder / "data.csv").string();
  Sequence sequence;
  sequence.kind = "EuRoC";
  for (const TextLine& line : split_lines(read_text_file(list), list)) {
    const auto fields = split_fields(line.text, ',');
    if (fields.size() != 2 || fields[1].empty())
      throw InputError(line.where, "is not `time,file name`", "restore data.csv");
    sequence.times.push_back(parse_nanoseconds(fields[0], line.where));
    sequence.images.push_back((camera_folder / "data" / fields[1]).string());
  }
  if (sequence.images.empty()) throw InputError(list, "names no images", "restore data.csv");
  sequence.camera = choose_or_assume_camera(options, (camera_folder / "sensor.yaml").string(),
                                            seen_images(sequence.images), &sequence.decisions);
  sequence.details.emplace_back("camera folder", camera_folder.filename().string());
  if (const std::string truth = euroc_ground_truth_path(options.path); !truth.empty())
    sequence.details.emplace_back("ground truth", truth + " (EuRoC format)");
  return sequence;
}

// `ns, px, py, pz, qw, qx, qy, qz, ...` of the body a line.
std::string euroc_ground_truth(const SourceOptions& options) {
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
    if (!(std::abs(q.norm() - 1) < kQuaternionError))
      throw InputError(line.where, "the quaternion is not of unit length", "restore the file");
    append_pose(&text, parse_nanoseconds(fields[0], line.where),
                SE3(q, Eigen::Vector3d(v[0], v[1], v[2])) * T_body_cam);
  }
  return text;
}

}  // namespace

Layout euroc_layout() { return {is_euroc_layout, read_euroc_layout, true, euroc_ground_truth}; }

}  // namespace edgevo
