// SPDX-License-Identifier: BSD-3-Clause
#include "recorded_camera.h"

#include <algorithm>
#include <cmath>

#include "camera_change.h"
#include "lens_text.h"

namespace edgevo {
namespace {

constexpr const char* kCameraInfo = "sensor_msgs/CameraInfo";
constexpr const char* kFile = "give the camera with --camera";

std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

bool is_calibrated(const CameraInfoMessage& info) { return info.K[0] > 0 && info.K[4] > 0; }

LensKind lens_of(const CameraInfoMessage& info, const std::string& where) {
  if (std::all_of(info.D.begin(), info.D.end(), [](double d) { return d == 0; })) return LensKind::kPinhole;
  if (const auto kind = lens_of_name(info.distortion_model)) return *kind;
  throw InputError(where, "its distortion model '" + info.distortion_model + "' is not read", kFile);
}

// For the full image.
Camera full_camera(const CameraInfoMessage& info, bool is_rectified, const std::string& where) {
  StatedLens lens;
  if (is_rectified && info.P[0] > 0) {
    lens.intrinsics = {info.P[0], info.P[5], info.P[2], info.P[6]};
  } else {
    lens.intrinsics = {info.K[0], info.K[4], info.K[2], info.K[5]};
    lens.kind = lens_of(info, where);
    if (lens.kind != LensKind::kPinhole) lens.coefficients = info.D;
  }
  Camera camera;
  camera.model = model_of(lens, where);
  camera.width = info.width, camera.height = info.height;
  return camera;
}

// Size over which pixels were added up.
int binning(uint32_t stated) { return int(std::clamp(stated, 1u, 64u)); }

bool has_part(const CameraInfoMessage& info) {
  return info.binning_x > 1 || info.binning_y > 1 || info.roi_width > 0;
}

// Cut as roi and reduced as binning says.
Camera recorded_part(const Camera& full, const CameraInfoMessage& info) {
  if (!has_part(info)) return full;
  const int width = info.roi_width > 0 ? int(info.roi_width) : full.width;
  const int height = info.roi_height > 0 ? int(info.roi_height) : full.height;
  const int x = binning(info.binning_x), y = binning(info.binning_y);
  const Camera part = cut_camera(full, info.roi_x, info.roi_y, width, height);
  Pinhole p = part.pinhole();
  p = {p.fx / x, p.fy / y, (p.cx + 0.5) / x - 0.5, (p.cy + 0.5) / y - 0.5, width / x, height / y};
  Camera camera = part;
  camera.set_pinhole(p);
  return camera;
}

bool is_same_shape(const Camera& camera, int width, int height) {
  const double x = double(width) / camera.width, y = double(height) / camera.height;
  return std::abs(x * camera.height - height) <= 1 || std::abs(y * camera.width - width) <= 1;
}

// Drivers that state a roi or binning without having applied it are believed by the size of their images.
Camera fitted(const Camera& full, const CameraInfoMessage& info, int width, int height,
              const std::string& where, std::vector<InputDecision>* decisions) {
  const Camera part = recorded_part(full, info);
  if (part.width == width && part.height == height) return part;
  if (full.width == width && full.height == height) {
    decisions->push_back(
        {"camera", "for the full image", "its roi or binning does not fit the size of the images", ""});
    return full;
  }
  if (part.width <= 0 || part.height <= 0 || !is_same_shape(part, width, height))
    throw InputError(where,
                     "is for images of " + size_text(part.width, part.height) + ", but these have " +
                         size_text(width, height),
                     kFile);
  decisions->push_back(
      {"camera", "scaled from " + size_text(part.width, part.height) + " to " + size_text(width, height),
       "the images have the shape of those of " + where, ""});
  return scaled_camera(part, width, height);
}

std::string parent(const std::string& topic) { return topic.substr(0, topic.rfind('/') + 1); }

// "/cam/image_raw" of "/cam/image_raw/compressed".
std::string base_topic(const ImageTopic& image) {
  const std::string above = parent(image.name);
  return image.is_compressed && above.size() > 1 && above.find("image") != std::string::npos
             ? above.substr(0, above.size() - 1)
             : image.name;
}

std::optional<CameraInfoMessage> first_info(Recording* recording, size_t topic, const std::string& path) {
  constexpr uint64_t kSearchBytes = 64 << 20;  // of a file without an index
  recording->select({{topic}, SIZE_MAX, kSearchBytes});
  const auto message = recording->next();
  if (!message) return std::nullopt;
  const RecordedTopic& recorded = recording->topics()[topic];
  return decode_camera_info(message->bytes, recorded.serialization, path + ", " + recorded.name);
}

}  // namespace

bool names_rectified(const std::string& topic) {
  const size_t at = topic.find("image_rect");
  return at != std::string::npos && (at == 0 || topic[at - 1] == '/');
}

std::optional<Camera> camera_of_info(const CameraInfoMessage& info, bool is_rectified, int width, int height,
                                     const std::string& where, std::vector<InputDecision>* decisions) {
  if (!is_calibrated(info)) return std::nullopt;
  CameraInfoMessage sized = info;
  if (sized.width == 0 || sized.height == 0) {
    sized.width = width * binning(info.binning_x);
    sized.height = height * binning(info.binning_y);
    sized.roi_width = sized.roi_height = 0;
  }
  const Camera full = full_camera(sized, is_rectified, where);
  const Camera camera = fitted(full, sized, width, height, where, decisions);
  camera.check(where);
  return camera;
}

std::optional<FoundCameraInfo> find_camera_info(Recording* recording, const ImageTopic& image,
                                                const std::string& path) {
  const auto& topics = recording->topics();
  const std::string sibling = parent(base_topic(image)) + "camera_info";
  std::vector<FoundCameraInfo> of_frame;
  for (size_t i = 0; i < topics.size(); ++i) {
    if (topics[i].type != kCameraInfo || topics[i].messages.value_or(1) == 0) continue;
    const auto info = first_info(recording, i, path);
    if (!info) continue;
    if (topics[i].name == sibling) return FoundCameraInfo{topics[i].name, *info};
    if (info->header.frame == image.frame) of_frame.push_back({topics[i].name, *info});
  }
  return of_frame.size() == 1 ? std::make_optional(of_frame.front()) : std::nullopt;
}

}  // namespace edgevo
