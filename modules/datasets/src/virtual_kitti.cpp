// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/virtual_kitti.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "camera_fit.h"
#include "edgevo/core/error.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "image_series.h"
#include "sequence.h"
#include "text_file.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

constexpr double kFps = 10;              // frames a second, KITTI's rate; there are no times
constexpr double kMetresPerUnit = 0.01;  // depth images hold centimetres
constexpr double kRotationError = 0.01;  // of R R^T from the identity: the files have few digits
constexpr unsigned kSky = 65535;         // centimetres in depth images: no depth

// Absolute, without a slash at its end.
fs::path sequence_folder(const std::string& folder) {
  std::error_code ignored;
  const fs::path path = fs::weakly_canonical(folder, ignored);
  return path.has_filename() ? path : path.parent_path();
}

// ---- paths ----

bool is_release_1(const fs::path& sequence) {
  return sequence.parent_path().parent_path().filename() == "vkitti_1.3.1_rgb";
}

std::vector<std::string> camera_names(const fs::path& sequence) {
  std::vector<std::string> found;
  std::error_code ignored;
  for (const char* name : {"Camera_0", "Camera_1"})
    if (fs::is_directory(sequence / "frames" / "rgb" / name, ignored)) found.push_back(name);
  return found;
}

std::string choose_camera_name(const fs::path& sequence, const std::string& wanted) {
  const auto found = camera_names(sequence);
  if (wanted.empty()) return found.front();
  if (std::find(found.begin(), found.end(), wanted) != found.end()) return wanted;
  throw InputError(sequence.string(), "no camera '" + wanted + "'",
                   "did you mean --sensor " + nearest_name(wanted, found) + "?");
}

// `path` with its folder `from` replaced by `to`, for archives unpacked side by side.
fs::path in_sibling(const fs::path& path, const std::string& from, const std::string& to) {
  fs::path other;
  for (const fs::path& part : path) other /= part == from ? fs::path(to) : part;
  return other;
}

// `relative` in the sequence's folder if it is there, else in the separate archive of release 2.
fs::path find_in_release_2(const fs::path& sequence, const std::string& relative,
                           const std::string& archive) {
  std::error_code ignored;
  const fs::path together = sequence / relative;
  return fs::exists(together, ignored) ? together
                                       : in_sibling(sequence, "vkitti_2.0.3_rgb", archive) / relative;
}

int frame_number(const std::string& path) {
  const std::string stem = fs::path(path).stem().string();
  const std::string digits = stem.substr(stem.find_last_not_of("0123456789") + 1);
  if (digits.empty() || digits.size() > 9)
    throw InputError(path, "has no frame number in its name", "restore the names of Virtual KITTI");
  return std::stoi(digits);
}

// ---- lists ----

// Rows of numbers below a header line that begins with "frame".
std::vector<TextLine> rows_of(const std::string& path) {
  std::vector<TextLine> lines = split_lines(read_text_file(path), path);
  if (lines.empty() || lines.front().text.rfind("frame", 0) != 0)
    throw InputError(path, "does not begin with its header line 'frame ...'", "restore the file");
  lines.erase(lines.begin());
  return lines;
}

// A frame's or a camera's number in a list.
int count_from(double value, const std::string& where) {
  if (!(value >= 0 && value < 1e9) || value != std::floor(value))
    throw InputError(where, "has no frame number", "restore the file");
  return int(value);
}

SE3 pose_from(const std::vector<double>& numbers, size_t first, const std::string& where) {
  Eigen::Matrix4d M;
  for (int i = 0; i < 16; ++i) M(i / 4, i % 4) = numbers[first + size_t(i)];
  const Eigen::Matrix3d R = M.topLeftCorner<3, 3>();
  const bool is_rotation =
      (R * R.transpose() - Eigen::Matrix3d::Identity()).norm() < kRotationError && R.determinant() > 0;
  if (!is_rotation || M.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    throw InputError(where, "the matrix is not a rigid motion", "restore the file");
  return SE3(R, Eigen::Vector3d(M.topRightCorner<3, 1>())).inverse();  // the file maps world to camera
}

// Poses by frame number. Release 2 has the camera's number in the second column.
std::map<int, SE3> read_poses(const std::string& path, const std::string& camera_name) {
  const size_t first = camera_name.empty() ? 1 : 2;
  std::map<int, SE3> poses;
  for (const TextLine& line : rows_of(path)) {
    const auto numbers = parse_numbers(line, first + 16, "a frame and a 4x4 matrix, row by row");
    if (first == 2 && count_from(numbers[1], line.where) != camera_name.back() - '0') continue;
    poses[count_from(numbers[0], line.where)] = pose_from(numbers, first, line.where);
  }
  return poses;
}

Camera read_intrinsics(const std::string& path, const std::string& camera_name, const GrayImage& image) {
  Camera camera;
  for (const TextLine& line : rows_of(path)) {
    const auto n = parse_numbers(line, 6, "frame, camera, fx, fy, cx, cy");
    if (count_from(n[1], line.where) != camera_name.back() - '0') continue;
    const Pinhole pinhole{n[2], n[3], n[4], n[5], image.width, image.height};
    const Pinhole before = camera.pinhole();
    if (before.width > 0 && (before.fx != pinhole.fx || before.fy != pinhole.fy || before.cx != pinhole.cx ||
                             before.cy != pinhole.cy))
      throw InputError(line.where, "the calibration changes within the sequence", "restore the file");
    camera.set_pinhole(pinhole);
  }
  camera.check(path);
  return camera;
}

void set_poses(const std::string& path, VirtualKitti* sequence) {
  sequence->poses_path = path;
  const auto poses = read_poses(path, sequence->camera_name);
  for (const std::string& image : sequence->images) {
    const auto pose = poses.find(frame_number(image));
    if (pose == poses.end())
      throw InputError(path, "no pose of frame " + std::to_string(frame_number(image)), "restore the file");
    sequence->T_world_cam.push_back(pose->second);
  }
}

std::string numbered(const fs::path& folder, const char* before, int frame) {
  char name[32];
  std::snprintf(name, sizeof name, "%s%05d.png", before, frame);
  return (folder / name).string();
}

VirtualKitti read_release_1(const fs::path& sequence) {
  const std::string variation = sequence.filename().string(),
                    world = sequence.parent_path().filename().string();
  const fs::path root = sequence.parent_path().parent_path().parent_path();
  VirtualKitti result;
  result.release = "1.3.1";
  result.images = list_images(sequence.string(), {}, nullptr);
  const GrayImage first = read_gray_image(result.images.front());
  result.camera.set_pinhole({725, 725, 620.5, 187, first.width, first.height});  // of the release's README
  for (const std::string& image : result.images)
    result.depths.push_back(
        numbered(root / "vkitti_1.3.1_depthgt" / world / variation, "", frame_number(image)));
  const std::string poses =
      existing((root / "vkitti_1.3.1_extrinsicsgt" / (world + "_" + variation + ".txt")).string());
  if (!poses.empty()) set_poses(poses, &result);
  return result;
}

VirtualKitti read_release_2(const fs::path& sequence, const std::string& wanted_camera) {
  VirtualKitti result;
  result.release = "2.0.3";
  result.camera_name = choose_camera_name(sequence, wanted_camera);
  result.images = list_images((sequence / "frames" / "rgb" / result.camera_name).string(), {}, nullptr);
  const fs::path depth =
      find_in_release_2(sequence, "frames/depth/" + result.camera_name, "vkitti_2.0.3_depth");
  for (const std::string& image : result.images)
    result.depths.push_back(numbered(depth, "depth_", frame_number(image)));
  const std::string intrinsics = find_in_release_2(sequence, "intrinsic.txt", "vkitti_2.0.3_textgt").string();
  result.camera = read_intrinsics(intrinsics, result.camera_name, read_gray_image(result.images.front()));
  const std::string poses =
      existing(find_in_release_2(sequence, "extrinsic.txt", "vkitti_2.0.3_textgt").string());
  if (!poses.empty()) set_poses(poses, &result);
  return result;
}

}  // namespace

bool is_virtual_kitti(const std::string& folder) {
  const fs::path sequence = sequence_folder(folder);
  return is_release_1(sequence) || !camera_names(sequence).empty();
}

VirtualKitti read_virtual_kitti(const SourceOptions& options) {
  const fs::path sequence = sequence_folder(options.path);
  if (is_release_1(sequence) && !options.sensor_label.empty())
    throw InputError(options.path,
                     "no sensor '" + options.sensor_label + "': it has one camera, without a name",
                     "leave --sensor out");
  VirtualKitti result =
      is_release_1(sequence) ? read_release_1(sequence) : read_release_2(sequence, options.sensor_label);
  if (!options.camera_file.empty())
    result.camera =
        camera_of_file(camera_file_of(options, ""), seen_images(result.images), &result.decisions);
  const double fps = options.fps > 0 ? options.fps : kFps;
  for (const std::string& image : result.images)
    result.times.push_back(Timestamp::from_seconds(frame_number(image) / fps));
  return result;
}

std::vector<float> read_virtual_kitti_depth(const std::string& path, int width, int height) {
  const GrayImage whole = read_gray_image(path);  // for its checks: missing, cut short, damaged
  if (whole.width != width || whole.height != height)
    throw InputError(path,
                     "has " + std::to_string(whole.width) + " x " + std::to_string(whole.height) +
                         " pixels, the image " + std::to_string(width) + " x " + std::to_string(height),
                     "restore the file");
  const cv::Mat image = cv::imread(path, cv::IMREAD_UNCHANGED);
  if (image.type() != CV_16UC1) throw InputError(path, "is not a depth image of 16 bits", "restore the file");
  std::vector<float> depth(size_t(width) * height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const unsigned value = image.at<uint16_t>(y, x);
      depth[size_t(y) * width + x] = value == kSky ? 0.0f : float(kMetresPerUnit * value);
    }
  return depth;
}

}  // namespace edgevo
