// SPDX-License-Identifier: BSD-3-Clause
// Camera files in the formats of other programs. Each refuses lenses that the program does not have.
#include <algorithm>
#include <functional>

#include "edgevo/core/error.h"
#include "edgevo/datasets/camera_file.h"
#include "lens_text.h"
#include "yaml_text.h"

namespace edgevo {
namespace {

struct Writer {
  const char* format;
  std::string (*text)(const Camera& camera, const StatedLens& lens, const std::string& comment);
};

[[noreturn]] void refuse_lens(const char* program, const StatedLens& lens, const std::string& remedy) {
  throw InputError("camera", std::string(program) + " has no lens " + name_of(lens.kind), remedy);
}

std::string entry(const std::string& key, double value) { return key + ": " + yaml_real(value) + "\n"; }
std::string entry(const std::string& key, int value) { return key + ": " + std::to_string(value) + "\n"; }

// ---- ROS ----

std::string ros_text(const Camera& camera, const StatedLens& lens, const std::string& comment) {
  const LensKind kinds[] = {LensKind::kPinhole, LensKind::kPlumbBob, LensKind::kRational,
                            LensKind::kKannalaBrandt};
  if (!std::count(std::begin(kinds), std::end(kinds), lens.kind))
    refuse_lens("ROS", lens, "calibrate as fisheye, or omit --format");
  return camera_yaml(camera, comment);
}

// ---- Kalibr ----

struct KalibrNames {
  const char* camera_model;
  const char* distortion_model;
  /// How many of the coefficients are in front of the focal lengths.
  size_t in_intrinsics;
};

KalibrNames kalibr_names(const StatedLens& lens) {
  switch (lens.kind) {
    case LensKind::kPinhole:
      return {"pinhole", "none", 0};
    case LensKind::kPlumbBob:
      return {"pinhole", "radtan", 0};
    case LensKind::kKannalaBrandt:
      return {"pinhole", "equidistant", 0};
    case LensKind::kFov:
      return {"pinhole", "fov", 0};
    case LensKind::kExtendedUnified:
      return {"eucm", "none", 2};
    case LensKind::kDoubleSphere:
      return {"ds", "none", 2};
    case LensKind::kOmni:
      return {"omni", "radtan", 1};
    default:
      refuse_lens("Kalibr", lens, "calibrate as plumb_bob or fisheye");
  }
}

std::string kalibr_text(const Camera& camera, const StatedLens& lens, const std::string& comment) {
  const KalibrNames names = kalibr_names(lens);
  std::vector<double> k = lens.coefficients;
  if (lens.kind == LensKind::kPlumbBob) {
    if (k[4] != 0)
      throw InputError("camera", "Kalibr's radtan has no k3",
                       "calibrate without it, or choose another format");
    k.pop_back();
  }
  const auto split = k.begin() + long(names.in_intrinsics);
  const Intrinsics& i = lens.intrinsics;
  std::vector<double> intrinsics(k.begin(), split);
  for (const double value : {i.fx, i.fy, i.cx, i.cy}) intrinsics.push_back(value);
  return yaml_comment(comment) + "cam0:\n  cam_overlaps: []\n  camera_model: " + names.camera_model +
         "\n  distortion_coeffs: " + yaml_list({split, k.end()}) +
         "\n  distortion_model: " + names.distortion_model + "\n  intrinsics: " + yaml_list(intrinsics) +
         "\n  resolution: [" + std::to_string(camera.width) + ", " + std::to_string(camera.height) +
         "]\n  rostopic: /cam0/image_raw\n";
}

// ---- ORB-SLAM ----

// The keys that version 2 knows, and 3 still reads.
std::string orb_slam_text(const Camera& camera, const StatedLens& lens, const std::string& comment) {
  const bool is_fisheye = lens.kind == LensKind::kKannalaBrandt;
  if (!is_fisheye && lens.kind != LensKind::kPinhole && lens.kind != LensKind::kPlumbBob)
    refuse_lens("ORB-SLAM", lens, "calibrate as plumb_bob or fisheye");
  const Intrinsics& i = lens.intrinsics;
  std::string text = "%YAML:1.0\n---\n" + yaml_comment(comment) +
                     "Camera.type: " + (is_fisheye ? "\"KannalaBrandt8\"" : "\"PinHole\"") + "\n" +
                     entry("Camera.fx", i.fx) + entry("Camera.fy", i.fy) + entry("Camera.cx", i.cx) +
                     entry("Camera.cy", i.cy);
  std::vector<double> k = lens.coefficients;
  k.resize(is_fisheye ? 4 : 5, 0.0);
  const auto names = coefficient_names(is_fisheye ? LensKind::kKannalaBrandt : LensKind::kPlumbBob);
  for (size_t n = 0; n < k.size(); ++n) text += entry("Camera." + names[n], k[n]);
  return text + entry("Camera.width", camera.width) + entry("Camera.height", camera.height);
}

// ---- OpenCV ----

std::string opencv_matrix(const char* key, int rows, const std::vector<double>& data) {
  return std::string(key) + ": !!opencv-matrix\n   rows: " + std::to_string(rows) +
         "\n   cols: " + std::to_string(int(data.size()) / rows) + "\n   dt: d\n   data: " + yaml_list(data) +
         "\n";
}

// As its samples write it: calib3d's, of which fisheye_model says that the lens is one, and omnidir's with
// xi.
std::string opencv_text(const Camera& camera, const StatedLens& lens, const std::string& comment) {
  const bool is_omni = lens.kind == LensKind::kOmni, is_fisheye = lens.kind == LensKind::kKannalaBrandt;
  std::vector<double> k = lens.coefficients;
  if (lens.kind == LensKind::kPinhole) k.assign(5, 0.0);
  if (k.size() < 4) refuse_lens("OpenCV", lens, "calibrate as fisheye or rational");
  if (is_omni) k.erase(k.begin());
  const Intrinsics& i = lens.intrinsics;
  return "%YAML:1.0\n---\n" + yaml_comment(comment) + entry("image_width", camera.width) +
         entry("image_height", camera.height) + (is_omni ? "" : entry("fisheye_model", int(is_fisheye))) +
         opencv_matrix("camera_matrix", 3, {i.fx, 0, i.cx, 0, i.fy, i.cy, 0, 0, 1}) +
         opencv_matrix("distortion_coefficients", int(k.size()), k) +
         (is_omni ? entry("xi", lens.coefficients[0]) : "");
}

constexpr Writer kWriters[] = {
    {"ros", ros_text}, {"kalibr", kalibr_text}, {"orb_slam", orb_slam_text}, {"opencv", opencv_text}};

}  // namespace

std::vector<std::string> camera_file_formats() {
  std::vector<std::string> names;
  for (const Writer& writer : kWriters) names.emplace_back(writer.format);
  return names;
}

std::string camera_file_text(const Camera& camera, const std::string& format, const std::string& comment) {
  for (const Writer& writer : kWriters)
    if (format == writer.format) return writer.text(camera, stated_lens(camera.model), comment);
  std::string known;
  for (const std::string& name : camera_file_formats()) known += (known.empty() ? "" : ", ") + name;
  throw InputError("format '" + format + "'", "is not known", "choose one of " + known);
}

}  // namespace edgevo
