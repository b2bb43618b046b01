// SPDX-License-Identifier: BSD-3-Clause
#include "assumed_camera.h"

#include <libexif/exif-data.h>

#include <cmath>
#include <memory>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "sequence.h"

namespace edgevo {
namespace {

constexpr double kFilmDiagonal = 43.267;  // mm, of 36 x 24: what "35 mm equivalent" is measured by
constexpr double kAnyFov = 60;            // for callers that do not need the camera

struct Guess {
  double f_px;
  std::string by;
};

Camera camera_of_focal_length(double f, int width, int height) {
  Camera camera;
  camera.set_pinhole({f, f, 0.5 * (width - 1), 0.5 * (height - 1), width, height});
  return camera;
}

double focal_length_of_fov(double fov_deg, int width) { return 0.5 * width / std::tan(fov_deg * M_PI / 360); }

std::optional<Guess> guess_from_exif(const FirstImage& image) {
  const auto mm = image.path.empty() ? std::nullopt : focal_length_35mm(image.path);
  if (!mm) return std::nullopt;
  return Guess{*mm / kFilmDiagonal * std::hypot(image.width, image.height),
               "by EXIF's focal length, " + std::to_string(*mm) + " mm in terms of 35 mm film"};
}

void read_size(FirstImage* image) {
  if (image->width > 0) return;
  const GrayImage pixels = read_gray_image(image->path);
  image->width = pixels.width;
  image->height = pixels.height;
}

std::optional<Camera> assume(const SourceOptions& options, const std::string& own, FirstImage image,
                             Details* details) {
  if (!options.camera_file.empty() || (!options.fov_deg && !existing(own).empty())) return std::nullopt;
  read_size(&image);
  std::optional<Guess> guess;
  if (options.fov_deg)
    guess = Guess{focal_length_of_fov(*options.fov_deg, image.width), "by --fov"};
  else
    guess = guess_from_exif(image);
  if (!guess && options.any_camera) return camera_of_field_of_view(kAnyFov, image.width, image.height);
  if (!guess) return std::nullopt;
  details->emplace_back(kAssumed, guess->by + ": f " + fixed(guess->f_px, 0) +
                                      " px, no lens distortion, centre in the middle; a calibration is "
                                      "better (edgevo calibrate --chessboard)");
  return camera_of_focal_length(guess->f_px, image.width, image.height);
}

}  // namespace

Camera camera_of_field_of_view(double fov_deg, int width, int height) {
  return camera_of_focal_length(focal_length_of_fov(fov_deg, width), width, height);
}

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

Camera choose_or_assume_camera(const SourceOptions& options, const std::string& own, const FirstImage& image,
                               Details* details) {
  if (const std::optional<Camera> assumed = assume(options, own, image, details)) return *assumed;
  return choose_camera(options, own);
}

}  // namespace edgevo
