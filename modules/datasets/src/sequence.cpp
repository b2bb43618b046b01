// SPDX-License-Identifier: BSD-3-Clause
#include "sequence.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "edgevo/core/bad_frame.h"
#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/files/image_names.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "text_file.h"
#include "time_unit.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

class SequenceSource : public ImageSource {
 public:
  explicit SequenceSource(Sequence sequence) : sequence_(std::move(sequence)) {}

  const Camera& camera() const override { return sequence_.camera; }
  std::optional<int> size() const override { return int(sequence_.images.size()); }
  std::string kind() const override { return sequence_.kind; }
  std::optional<SE3> T_vehicle_cam() const override { return sequence_.T_vehicle_cam; }
  VehicleTrack vehicle_track(VehicleSensor sensor) const override {
    return sensor == VehicleSensor::kGps ? sequence_.gps : VehicleTrack();
  }
  std::vector<std::pair<std::string, std::string>> details() const override { return sequence_.details; }
  std::vector<Timestamp> times() const override { return sequence_.times; }
  std::string ground_truth_path() const override { return sequence_.ground_truth_path; }

  std::optional<Frame> next() override {
    if (position_ >= sequence_.images.size()) return std::nullopt;
    // Stays at the end if its time is wrong.
    const size_t i = std::exchange(position_, sequence_.images.size());
    const std::string& path = sequence_.images[i];
    const Timestamp time = sequence_.times[i];
    if (previous_) check_time_increases(*previous_, time, path + " (frame " + std::to_string(i) + ")");
    previous_ = time;
    position_ = i + 1;  // a bad image does not end the sequence
    try {
      GrayImage image = read_gray_image(path);
      check_image_size(image, sequence_.camera.pinhole(), path);
      return Frame{int(i), time, std::move(image), path};
    } catch (const InputError& e) {
      throw BadFrame(int(i), time, e);
    }
  }
  bool skip() override {
    if (position_ >= sequence_.images.size()) return false;
    ++position_;
    return true;
  }

 private:
  Sequence sequence_;
  size_t position_ = 0;
  std::optional<Timestamp> previous_;
};

bool is_image_name(const fs::path& path) {
  std::string suffix = path.extension().string();
  for (char& c : suffix) c = char(std::tolower(static_cast<unsigned char>(c)));
  static const char* known[] = {".png", ".jpg", ".jpeg", ".bmp", ".pgm", ".ppm", ".tif", ".tiff"};
  return std::find(std::begin(known), std::end(known), suffix) != std::end(known);
}

}  // namespace

std::unique_ptr<ImageSource> play(Sequence sequence) {
  return std::make_unique<SequenceSource>(std::move(sequence));
}

std::vector<std::string> list_images(const std::string& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (is_image_name(entry.path())) names.push_back(entry.path().filename().string());
  if (error) throw InputError(folder, "the folder cannot be read: " + error.message(), "check the path");
  if (names.empty())
    throw InputError(folder, "the folder holds no images", "put images there (png, jpg, bmp, pgm, ppm, tif)");
  std::sort(names.begin(), names.end(), natural_less);
  for (std::string& name : names) name = (fs::path(folder) / name).string();
  return names;
}

std::vector<Timestamp> read_times(const std::string& path, Details* details) {
  return parse_times_of(split_lines(read_text_file(path), path), details);
}

std::vector<Timestamp> parse_times_of(const std::vector<TextLine>& lines, Details* details) {
  std::vector<std::string> texts;
  for (const TextLine& line : lines) texts.push_back(line.text);
  std::vector<Timestamp> times;
  TimeUnit unit{};
  size_t bad = 0;
  if (!parse_times(texts, &times, &unit, &bad))
    throw InputError(lines[bad].where, "is not a time", "write seconds, one number a line");
  if (unit.decimals > 0 && details)
    details->emplace_back("times", std::string("in ") + unit.name + ", by their size and steps");
  return times;
}

void check_counts(const std::vector<std::string>& images, const std::vector<Timestamp>& times,
                  const std::string& times_path, const std::string& images_folder) {
  if (images.size() == times.size()) return;
  throw InputError(times_path,
                   std::to_string(times.size()) + " times for " + std::to_string(images.size()) +
                       " images in " + images_folder,
                   "give one time for each image");
}

Camera choose_camera(const SourceOptions& options, const std::string& own) {
  if (!options.camera_file.empty()) return read_camera_file(options.camera_file);
  if (!existing(own).empty()) return read_camera_file(own);
  throw InputError(options.path, "no calibration" + (own.empty() ? "" : " (" + own + " is missing)"),
                   "give the camera's file with --camera (edgevo calibrate --chessboard makes one), or its "
                   "angle with --fov");
}

std::string existing(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) ? path : std::string();
}

}  // namespace edgevo
