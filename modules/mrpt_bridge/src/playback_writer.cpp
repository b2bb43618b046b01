// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/playback_writer.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/mrpt_bridge/edge_scan.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "edgevo/mrpt_bridge/vehicle_observations.h"
#include "object_file.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

// MRPT looks for the images of NAME.rawlog in NAME_Images.
constexpr const char* kImageFolder = "playback_Images";
constexpr const char* kRawlog = "playback.rawlog";
constexpr char kImageStem[] = "frame_%06d";

[[noreturn]] void fail(const fs::path& path, const std::error_code& error) {
  throw InputError(path.string(), "cannot be written: " + error.message(), "move it away or give another -o");
}

// Relative where image and link have more than the root in common.
fs::path link_target(const std::string& image_path, const fs::path& link_folder) {
  std::error_code ignored;
  const fs::path absolute = fs::absolute(image_path, ignored);
  const fs::path image = fs::weakly_canonical(absolute.parent_path(), ignored) / absolute.filename();
  const fs::path folder = fs::weakly_canonical(fs::absolute(link_folder, ignored), ignored);
  const bool share_a_folder = *std::next(image.begin()) == *std::next(folder.begin());
  return share_a_folder ? image.lexically_relative(folder) : image;
}

}  // namespace

PlaybackWriter::PlaybackWriter(std::string folder, const Camera& camera, std::string sensor_label)
    : folder_(std::move(folder)), camera_(camera), sensor_label_(std::move(sensor_label)) {
  make_output_folder((fs::path(folder_) / kImageFolder).string());
}

void PlaybackWriter::add_frame(const Frame& frame) {
  const std::string name = prepare_image(frame.index, ".png");
  write_png((fs::path(folder_) / kImageFolder / name).string(), frame.image);
  images_.emplace_back(frame.index, name);
}

void PlaybackWriter::add_frame_link(int frame_index, const std::string& image_path) {
  const std::string name = prepare_image(frame_index, fs::path(image_path).extension().string());
  const fs::path link = fs::path(folder_) / kImageFolder / name;
  std::error_code error;
  fs::create_symlink(link_target(image_path, link.parent_path()), link, error);
  if (error) fail(link, error);
  images_.emplace_back(frame_index, name);
}

void PlaybackWriter::add_frame_copy(int frame_index, const std::string& image_path) {
  const std::string name = prepare_image(frame_index, fs::path(image_path).extension().string());
  const fs::path copy = fs::path(folder_) / kImageFolder / name;
  std::error_code error, ignored;
  fs::copy_file(image_path, copy, error);
  if (error) fs::remove(copy, ignored);  // partial copy
  if (error) fail(copy, error);
  images_.emplace_back(frame_index, name);
}

void PlaybackWriter::adopt_images(int last) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(fs::path(folder_) / kImageFolder, ignored)) {
    const std::string name = entry.path().filename().string();
    int index = 0;
    if (std::sscanf(name.c_str(), kImageStem, &index) == 1 && index <= last)
      images_.emplace_back(index, name);
  }
  std::sort(images_.begin(), images_.end());
}

std::string PlaybackWriter::prepare_image(int frame_index, const std::string& extension) {
  char stem[32];
  std::snprintf(stem, sizeof stem, kImageStem, frame_index);
  const std::string name = stem + extension;
  // A link left by an earlier run must be removed: writing through it would change the image of the source.
  const fs::path path = fs::path(folder_) / kImageFolder / name;
  std::error_code error;
  fs::remove(path, error);
  if (error) fail(path, error);
  return name;
}

std::string PlaybackWriter::image_path(int frame_index) const {
  const auto image = std::lower_bound(images_.begin(), images_.end(), frame_index,
                                      [](const auto& entry, int index) { return entry.first < index; });
  if (image == images_.end() || image->first != frame_index) return {};
  return (fs::path(folder_) / kImageFolder / image->second).string();
}

void PlaybackWriter::finish(const Run& run, const PointFilter& filter) const {
  const SE3 T_vehicle_cam = T_map_world(run);  // in the unit of the run, as the points are
  const std::map<int, std::string> images(images_.begin(), images_.end());
  std::map<int, const KeyframeRecord*> keyframes;
  for (const KeyframeRecord& keyframe : run.keyframes) keyframes[keyframe.frame_index] = &keyframe;

  ObjectFile out((fs::path(folder_) / kRawlog).string());
  if (!run.frames.empty())
    out.write(*make_frames_observation(run, run.frames.front().time,
                                       "EDGE_VO is final, in map; EDGE_VO_LIVE is in odom"));
  for (const FrameRecord& frame : run.frames) {
    if (const auto image = images.find(frame.index); image != images.end()) {
      const auto obs = make_image_observation(frame.time, sensor_label_, camera_, run.T_vehicle_cam);
      obs->image.setExternalStorage(image->second);
      out.write(*obs);
    }
    if (const auto live = make_live_observation(run, frame)) out.write(*live);
    if (!frame.T_world_cam || !frame.T_world_cam->is_finite()) continue;
    out.write(*make_pose_observation(run, frame, *frame.T_world_cam));
    out.write(*make_odometry_observation(run, frame, *frame.T_world_cam));
    if (const auto doubt = make_doubt_observation(frame)) out.write(*doubt);
    if (const auto keyframe = keyframes.find(frame.index); keyframe != keyframes.end())
      out.write(*make_edge_scan(*keyframe->second, run.pinhole, filter, T_vehicle_cam));
  }
  out.close();
}

}  // namespace edgevo
