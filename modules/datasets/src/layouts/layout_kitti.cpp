// SPDX-License-Identifier: BSD-3-Clause
// KITTI odometry: sequences/NN/{image_0..3, calib.txt, times.txt}, poses/NN.txt.
#include <algorithm>
#include <array>
#include <filesystem>

#include "camera_fit.h"
#include "edgevo/core/error.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "image_series.h"
#include "layout.h"
#include "text_file.h"
#include "tum_text.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> camera_folders(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code ignored;
  for (const char* name : {"image_0", "image_1", "image_2", "image_3"})
    if (fs::is_directory(fs::path(folder) / name, ignored)) found.push_back(name);
  return found;
}

// calib.txt has the projection but not the size, which is taken from the images.
Camera camera_from_projection(const std::array<double, 12>& P, const std::string& first_image,
                              const std::string& where) {
  const GrayImage image = read_gray_image(first_image);
  Camera camera;
  camera.set_pinhole({P[0], P[5], P[2], P[6], image.width, image.height});
  camera.check(where);
  return camera;
}

bool is_kitti_layout(const std::string& folder) {
  return !camera_folders(folder).empty() && !existing((fs::path(folder) / "calib.txt").string()).empty();
}

// "image_0": the label the user gave, else the first of image_0 .. image_3 that is there.
std::string kitti_camera_folder(const SourceOptions& options) {
  const auto found = camera_folders(options.path);
  if (options.sensor_label.empty()) return found.front();
  if (std::find(found.begin(), found.end(), options.sensor_label) != found.end()) return options.sensor_label;
  std::string list;
  for (const std::string& name : found) list += (list.empty() ? "" : ", ") + name;
  throw InputError(options.path, "no camera '" + options.sensor_label + "'; there are " + list,
                   "did you mean --sensor " + nearest_name(options.sensor_label, found) + "?");
}

// The 3x4 projection matrix of that camera, row by row, from calib.txt.
std::array<double, 12> read_kitti_projection(const SourceOptions& options, const std::string& camera_folder) {
  const std::string path = (fs::path(options.path) / "calib.txt").string();
  const std::string key = std::string("P") + camera_folder.back() + ":";
  for (TextLine line : split_lines(read_text_file(path), path)) {
    if (line.text.rfind(key, 0) != 0) continue;
    line.text.erase(0, key.size());
    const auto numbers = parse_numbers(line, 12, key + " and the 3x4 projection matrix, row by row");
    std::array<double, 12> P{};
    std::copy(numbers.begin(), numbers.end(), P.begin());
    return P;
  }
  throw InputError(path, "no line '" + key + "'", "give the calibration with --camera, or restore calib.txt");
}

// Path ../../poses/NN.txt for sequences/NN; empty if there is none.
std::string kitti_poses_path(const std::string& folder) {
  const fs::path root = fs::path(folder + "/").parent_path();  // without trailing slashes
  return existing((root / ".." / ".." / "poses" / (root.filename().string() + ".txt")).string());
}

Sequence read_kitti_layout(const SourceOptions& options) {
  const fs::path root = options.path;
  const std::string name = kitti_camera_folder(options);
  const std::string images = (root / name).string(), times = (root / "times.txt").string();
  Sequence sequence;
  sequence.kind = "KITTI odometry";
  sequence.images = list_images(images, options, &sequence.decisions);
  sequence.times = read_times(times, options, &sequence.decisions);
  check_counts(sequence.images, sequence.times, times, images);
  sequence.camera =
      options.camera_file.empty()
          ? camera_from_projection(read_kitti_projection(options, name), sequence.images.front(),
                                   (root / "calib.txt").string())
          : camera_of_file(camera_file_of(options, ""), seen_images(sequence.images), &sequence.decisions);
  sequence.details.emplace_back("camera folder", name);
  if (const std::string poses = kitti_poses_path(options.path); !poses.empty())
    sequence.details.emplace_back("ground truth", poses + " (KITTI format)");
  return sequence;
}

// One pose of camera 0 a line, 3x4, row by row. The rectified cameras differ by a shift along x: P[3] is
// -fx x_cam.
std::string kitti_ground_truth(const SourceOptions& options) {
  const std::string poses = kitti_poses_path(options.path);
  if (poses.empty()) return {};
  const std::string times_path = (fs::path(options.path) / "times.txt").string();
  const auto times = read_times(times_path, options, nullptr);
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

}  // namespace

Layout kitti_layout() { return {is_kitti_layout, read_kitti_layout, true, kitti_ground_truth, true}; }

}  // namespace edgevo
