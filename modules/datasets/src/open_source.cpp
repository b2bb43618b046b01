// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/open_source.h"

#include <filesystem>
#include <limits>

#include "assumed_camera.h"
#include "camera_doubt.h"
#include "camera_fit.h"
#include "edgevo/core/error.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/datasets/scaled_source.h"
#include "edgevo/datasets/source_folder.h"
#include "edgevo/datasets/subsample.h"
#include "edgevo/mrpt_bridge/rawlog_source.h"
#include "edgevo/recordings/recording.h"
#include "gyro_source.h"
#include "layouts/layout.h"
#include "mounted_source.h"
#include "recording_source.h"
#include "symphony_archive.h"
#include "text_file.h"
#include "video_source.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLiveCamera = "camera:";

void refuse_label(const SourceOptions& options) {
  if (options.sensor_label.empty()) return;
  if (!options.camera_file.empty() && has_several_cameras(options.camera_file)) return;
  throw InputError(options.path,
                   "no sensor '" + options.sensor_label + "': it has one camera, without a name",
                   "omit --sensor");
}

void refuse_images(const SourceOptions& options) {
  if (options.images.empty()) return;
  throw InputError("--images", "is of no use: " + options.path + " lists its images itself", "omit it");
}

void refuse_bits(const SourceOptions& options) {
  if (options.bits == 0) return;
  throw InputError("--bits", "is of no use: images of a video or a live camera have 8 bits", "omit it");
}

void refuse_rate(const SourceOptions& options) {
  if (options.fps == 0) return;
  throw InputError("--fps", "is of no use: " + options.path + " has times of its own", "omit it");
}

void refuse_topic(const SourceOptions& options) {
  if (options.topic.empty()) return;
  throw InputError("--topic", "is of no use: " + options.path + " is not a recording of ROS", "omit it");
}

void refuse_time_unit(const SourceOptions& options) {
  if (options.time_unit.empty()) return;
  throw InputError("--time-unit", "is of no use: " + options.path + " has no times written as numbers",
                   "omit it");
}

std::unique_ptr<ImageSource> open_folder(const SourceOptions& options) {
  const Layout* layout = layout_of(options.path);
  if (!layout || !layout->has_labels) refuse_label(options);
  if (layout && !layout->lists_folder) refuse_images(options);
  if (layout && layout->has_times) refuse_rate(options);
  Sequence sequence = layout ? layout->read(options) : read_image_folder(options);
  sequence.any_size = options.any_size;
  return play(std::move(sequence), options.bits);
}

std::unique_ptr<ImageSource> open_rawlog_file(const SourceOptions& options) {
  refuse_images(options);
  refuse_rate(options);
  refuse_time_unit(options);
  RawlogSourceOptions rawlog{options.path, options.sensor_label, std::nullopt, {}, options.bits};
  const auto images = [&] {
    const auto [width, height] = first_image_size(rawlog);
    return SeenImages{{}, width, height, 0};
  };
  if (!options.camera_file.empty())
    rawlog.camera = camera_of_file(camera_file_of(options, ""), images(), &rawlog.decisions);
  try {
    return open_rawlog(rawlog);
  } catch (const InputError&) {  // most likely it has no calibration
    const SeenImages seen =
        rawlog.camera || !(options.fov_deg || options.any_camera) ? SeenImages() : images();
    if (seen.width == 0) throw;
    rawlog.camera = choose_or_assume_camera(options, "", seen, &rawlog.decisions);
    return open_rawlog(rawlog);
  }
}

void refuse_sensor(const SourceOptions& options) {
  if (options.sensor_label.empty()) return;
  if (!options.camera_file.empty() && has_several_cameras(options.camera_file)) return;
  throw InputError("--sensor", "is of no use: " + options.path + " has topics", "choose one with --topic");
}

std::unique_ptr<ImageSource> open_ros_recording(const SourceOptions& options) {
  refuse_sensor(options);
  refuse_images(options);
  refuse_rate(options);
  refuse_time_unit(options);
  return open_recording_source(options);
}

// The folder that a run wrote: its grid.pgm is no image of a camera, and its run.mcap may be without any.
void refuse_results(const fs::path& folder) {
  std::error_code ignored;
  for (const char* file : {"summary.yaml", "frames.csv"})
    if (!fs::is_regular_file(folder / file, ignored)) return;
  throw InputError(folder.string(), "is the folder of a run, not of images",
                   "read its summary.yaml and report.html; `edgevo info " + (folder / "map.db").string() +
                       "` shows its map");
}

std::unique_ptr<ImageSource> open_whole(const SourceOptions& options) {
  std::error_code ignored;
  const bool is_live = options.path.rfind(kLiveCamera, 0) == 0;
  if (!is_live && !layout_of(options.path)) refuse_results(options.path);
  const bool is_ros =
      !is_live && fs::exists(options.path, ignored) && !layout_of(options.path) && is_recording(options.path);
  if (!is_ros) refuse_topic(options);
  if (is_live) {
    refuse_images(options);
    refuse_bits(options);
    refuse_rate(options);
    refuse_time_unit(options);
    return open_live_camera(options);
  }
  if (options.path == "-" || options.path.find("://") != std::string::npos)
    throw InputError(
        options.path, "is a stream, which is not read",
        "record it to a file first (ffmpeg -i " + options.path + " -c copy video.mkv), and give that");
  if (!fs::exists(options.path, ignored))
    throw InputError(options.path, "no such file or folder", "check the path");
  if (is_ros) return open_ros_recording(options);
  if (fs::is_directory(options.path, ignored)) return open_folder(options);
  if (!fs::is_regular_file(options.path, ignored))
    throw InputError(options.path, "is a device or a pipe, not a file",
                     "give a file or a folder; a live camera is camera:N");
  if (fs::path(options.path).extension() == ".rawlog") return open_rawlog_file(options);
  refuse_label(options);
  refuse_images(options);
  refuse_bits(options);
  refuse_time_unit(options);
  return open_video(options);
}

// The camera file of a folder in the layout of `edgevo` or EuRoC; empty: none.
std::string camera_file_in(const SourceOptions& options) {
  const fs::path root = options.path, label = options.sensor_label.empty() ? "cam0" : options.sensor_label;
  std::error_code ignored;
  if (fs::is_directory(root / "images", ignored)) return existing((root / "camera.txt").string());
  return existing((root / "mav0" / label / "sensor.yaml").string());
}

// With the mount of --mount, else of the camera file, else the source's own.
std::unique_ptr<ImageSource> with_mount(std::unique_ptr<ImageSource> source, const SourceOptions& options) {
  if (options.mount) return mount_source(std::move(source), *options.mount, "--mount");
  const std::string file = options.camera_file.empty() ? camera_file_in(options) : options.camera_file;
  const std::optional<CameraMount> mount = file.empty() ? std::nullopt : read_camera_mount(file);
  return mount ? mount_source(std::move(source), *mount, file) : std::move(source);
}

// --camera-scale, where no camera file was read to which it applies.
void refuse_camera_scale(const SourceOptions& options, const ImageSource& source) {
  if (options.camera_scale == 0) return;
  for (const InputDecision& d : source.decisions())
    if (d.value.find("--camera-scale") != std::string::npos) return;
  throw InputError("--camera-scale", "is of no use: the camera of " + options.path + " is not from a file",
                   "omit it, or give the file with --camera");
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
  if (options.fov_deg && !assumes_camera(*source))
    throw InputError("--fov", "is of no use: " + options.path + " has its own calibration",
                     "omit it, or give another calibration with --camera");
  refuse_camera_scale(options, *source);
  source = with_gyro(with_mount(with_camera_doubt(std::move(source)), options), options);
  return scale_images(subsample(std::move(source), options), options.image_scale);
}

std::unique_ptr<ImageSource> open_source(const std::string& path) {
  SourceOptions options;
  options.path = path;
  return open_source(options);
}

}  // namespace edgevo
