// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/open_source.h"

#include <filesystem>
#include <limits>

#include "edgevo/core/error.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/datasets/scaled_source.h"
#include "edgevo/datasets/source_folder.h"
#include "edgevo/datasets/subsample.h"
#include "edgevo/mrpt_bridge/rawlog_source.h"
#include "layouts/layout.h"
#include "symphony_archive.h"
#include "text_file.h"
#include "video_source.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLiveCamera = "camera:";

void refuse_label(const SourceOptions& options) {
  if (options.sensor_label.empty()) return;
  throw InputError(options.path,
                   "no sensor '" + options.sensor_label + "': it has one camera, without a name",
                   "omit --sensor");
}

std::unique_ptr<ImageSource> open_folder(const SourceOptions& options) {
  const Layout* layout = layout_of(options.path);
  if (!layout || !layout->has_labels) refuse_label(options);
  return play(layout ? layout->read(options) : read_image_folder(options));
}

std::unique_ptr<ImageSource> open_rawlog_file(const SourceOptions& options) {
  RawlogSourceOptions rawlog{options.path, options.sensor_label, std::nullopt};
  if (!options.camera_file.empty()) rawlog.camera = read_camera_file(options.camera_file);
  return open_rawlog(rawlog);
}

std::unique_ptr<ImageSource> open_whole(const SourceOptions& options) {
  std::error_code ignored;
  if (options.path.rfind(kLiveCamera, 0) == 0) return open_live_camera(options);
  if (!fs::exists(options.path, ignored))
    throw InputError(options.path, "no such file or folder", "check the path");
  if (fs::is_directory(options.path, ignored)) return open_folder(options);
  if (!fs::is_regular_file(options.path, ignored))
    throw InputError(options.path, "is a device or a pipe, not a file",
                     "give a file or a folder; a live camera is camera:N");
  if (fs::path(options.path).extension() == ".rawlog") return open_rawlog_file(options);
  refuse_label(options);
  return open_video(options);
}

bool is_assumed(const ImageSource& source) {
  for (const auto& [name, value] : source.details())
    if (name == kAssumed) return true;
  return false;
}

int parse_frame_number(const std::string& text, const std::string& where) {
  const double value = parse_number(text, where);
  if (value < 0 || value > std::numeric_limits<int>::max() || value != int(value))
    throw InputError(where, quote(text) + " is not a frame number", "count from 0");
  return int(value);
}

}  // namespace

void set_frame_range(const std::string& text, SourceOptions* options) {
  const std::string where = "--frames " + quote(text);
  const size_t colon = text.find(':');
  if (colon == std::string::npos || text == ":")
    throw InputError(where, "is not A:B", "give for example --frames 0:300");
  const std::string first = text.substr(0, colon), last = text.substr(colon + 1);
  options->first = first.empty() ? 0 : parse_frame_number(first, where);
  options->last = last.empty() ? std::nullopt : std::optional<int>(parse_frame_number(last, where));
  if (options->last && *options->last <= options->first)
    throw InputError(where, "holds no frame", "A:B means frames A to B-1, so B must be larger than A");
}

std::string source_folder(const std::string& path) {
  if (path.rfind(kLiveCamera, 0) == 0 || layout_of(path)) return path;
  return survey_folder(path);
}

std::unique_ptr<ImageSource> open_source(const SourceOptions& requested) {
  SourceOptions options = requested;
  options.path = source_folder(requested.path);
  auto source = open_whole(options);
  if (options.fov_deg && !is_assumed(*source))
    throw InputError("--fov", "is of no use: " + options.path + " has its own calibration",
                     "omit it, or give another calibration with --camera");
  const double scale =
      options.image_scale == 0 ? usual_image_scale(source->camera().pinhole().width) : options.image_scale;
  return scale_images(subsample(std::move(source), options), scale);
}

}  // namespace edgevo
