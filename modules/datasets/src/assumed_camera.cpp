// SPDX-License-Identifier: BSD-3-Clause
#include "assumed_camera.h"

#include <libexif/exif-data.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "sequence.h"

namespace edgevo {
namespace {

constexpr double kFilmDiagonal = 43.267;           // mm, of 36 x 24: what "35 mm equivalent" is measured by
constexpr const char* kAssumedCamera = "assumed";  // what values of the decision begin with
constexpr const char* kUnknownCamera = "not known";
constexpr double kAnyFov = 60;  // for callers that do not need the camera

struct Guess {
  double f_px;
  std::string by;
};

Camera camera_of_focal_length(double f, int width, int height) {
  Camera camera;
  camera.set_pinhole({f, f, 0.5 * (width - 1), 0.5 * (height - 1), width, height});
  return camera;
}

double focal_length_of_fov(double fov_deg, int side) { return 0.5 * side / std::tan(fov_deg * M_PI / 360); }

// "the width" of a landscape image.
std::string longer_side(int width, int height) {
  return height > width ? "the height, which is the longer side" : "the width";
}

Guess guess_from_fov(double fov_deg, const SeenImages& images) {
  return Guess{
      focal_length_of_fov(fov_deg, std::max(images.width, images.height)),
      "by --fov, " + fixed(fov_deg, 1) + " degrees over " + longer_side(images.width, images.height)};
}

std::optional<Guess> guess_from_exif(const SeenImages& images) {
  const auto f = exif_focal_length_px(images);
  if (!f) return std::nullopt;
  const int mm = *focal_length_35mm(images.paths.front());
  return Guess{
      *f, "by EXIF's focal length, " + std::to_string(mm) + " mm in terms of 35 mm film, over the diagonal"};
}

void read_size(SeenImages* images) {
  find_size(0, 0, images);
  if (images->width == 0 && !images->paths.empty()) read_gray_image(images->paths.front());  // says why
}

InputDecision assumption(const Guess& guess) {
  return {"camera", std::string(kAssumedCamera) + ", f " + fixed(guess.f_px, 0) + " px",
          guess.by + "; no lens distortion, centre in the middle",
          "It is a guess: path, map and rotations are off as much as it is. A calibration is better (edgevo "
          "calibrate --chessboard)."};
}

std::optional<Camera> assume(const SourceOptions& options, const std::string& own, SeenImages images,
                             std::vector<InputDecision>* decisions) {
  if (!options.camera_file.empty() || (!options.fov_deg && !existing(own).empty())) return std::nullopt;
  read_size(&images);
  const std::optional<Guess> guess =
      options.fov_deg ? guess_from_fov(*options.fov_deg, images) : guess_from_exif(images);
  if (!guess && !options.any_camera) return std::nullopt;
  if (!guess) {
    decisions->push_back(
        {"camera", kUnknownCamera,
         "no calibration: a run needs --camera FILE, --camera auto, or --fov DEGREES to start with", ""});
    return camera_of_field_of_view(kAnyFov, images.width, images.height);
  }
  decisions->push_back(assumption(*guess));
  return camera_of_focal_length(guess->f_px, images.width, images.height);
}

bool has_camera_decision(const ImageSource& source, const std::string& value) {
  for (const InputDecision& d : source.decisions())
    if (d.subject == "camera" && d.value.rfind(value, 0) == 0) return true;
  return false;
}

}  // namespace

Camera camera_of_field_of_view(double fov_deg, int width, int height) {
  return camera_of_focal_length(focal_length_of_fov(fov_deg, std::max(width, height)), width, height);
}

bool assumes_camera(const ImageSource& source) { return has_camera_decision(source, kAssumedCamera); }

bool knows_camera(const ImageSource& source) { return !has_camera_decision(source, kUnknownCamera); }

std::optional<int> focal_length_35mm(const std::string& image_path) {
  const std::unique_ptr<ExifData, void (*)(ExifData*)> data(exif_data_new_from_file(image_path.c_str()),
                                                            exif_data_unref);
  if (!data) return std::nullopt;
  const ExifEntry* entry =
      exif_content_get_entry(data->ifd[EXIF_IFD_EXIF], EXIF_TAG_FOCAL_LENGTH_IN_35MM_FILM);
  if (!entry || entry->format != EXIF_FORMAT_SHORT || entry->size < 2) return std::nullopt;
  const int mm = exif_get_short(entry->data, exif_data_get_byte_order(data.get()));
  return mm > 0 ? std::optional<int>(mm) : std::nullopt;  // 0: unknown
}

std::optional<double> exif_focal_length_px(const SeenImages& images) {
  const auto mm = images.paths.empty() ? std::nullopt : focal_length_35mm(images.paths.front());
  if (!mm || images.width == 0) return std::nullopt;
  return *mm / kFilmDiagonal * std::hypot(images.width, images.height);
}

Camera choose_or_assume_camera(const SourceOptions& options, const std::string& own, const SeenImages& images,
                               std::vector<InputDecision>* decisions) {
  if (const std::optional<Camera> assumed = assume(options, own, images, decisions)) return *assumed;
  return camera_of_file(camera_file_of(options, own), images, decisions);
}

}  // namespace edgevo
