#include "sequence.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "edgevo/core/error.h"
#include "edgevo/core/image_names.h"
#include "edgevo/core/frame_checks.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "text_file.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

class SequenceSource : public ImageSource {
 public:
  explicit SequenceSource(Sequence sequence) : sequence_(std::move(sequence)) {}

  const Camera& camera() const override { return sequence_.camera; }
  std::optional<int> size() const override { return int(sequence_.images.size()); }
  std::string kind() const override { return sequence_.kind; }
  std::vector<std::pair<std::string, std::string>> details() const override { return sequence_.details; }
  std::vector<Timestamp> times() const override { return sequence_.times; }
  std::string ground_truth_path() const override { return sequence_.ground_truth_path; }

  std::optional<Frame> next() override {
    if (position_ >= sequence_.images.size()) return std::nullopt;
    const size_t i = std::exchange(position_, sequence_.images.size());  // stays at the end if a check throws
    const std::string& path = sequence_.images[i];
    const Timestamp time = sequence_.times[i];
    if (previous_) check_time_increases(*previous_, time, path + " (frame " + std::to_string(i) + ")");
    GrayImage image = read_gray_image(path);
    check_image_size(image, sequence_.camera.pinhole, path);
    previous_ = time;
    position_ = i + 1;
    return Frame{int(i), time, std::move(image), path};
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

std::vector<Timestamp> read_times(const std::string& path) {
  std::vector<Timestamp> times;
  for (const TextLine& line : split_lines(read_text_file(path), path)) {
    Timestamp t;
    if (!parse_seconds(line.text, &t))
      throw InputError(line.where, "is not a time", "write seconds, one number a line");
    times.push_back(t);
  }
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
                   "give the camera's file with --camera (edgevo calibrate --chessboard makes one), or its angle with --fov");
}

std::string existing(const std::string& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored) ? path : std::string();
}

}  // namespace edgevo
