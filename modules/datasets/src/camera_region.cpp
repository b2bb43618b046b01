// SPDX-License-Identifier: BSD-3-Clause
#include "camera_region.h"

#include <algorithm>
#include <cmath>

#include "camera_change.h"
#include "edgevo/core/error.h"

namespace edgevo {
namespace {

// A whole number of pixels; 0 if the file has none.
int whole(const YamlValues& values, const char* key, const std::string& where) {
  constexpr double kMax = 1e6;
  const auto all = yaml_numbers(values, {key}, where);
  if (all.empty()) return 0;
  if (!(all[0] >= 0 && all[0] <= kMax) || all[0] != std::floor(all[0]))
    throw InputError(where, std::string(key) + " is not a whole number of pixels", "correct it");
  return int(all[0]);
}

std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

void add_note(const std::string& note, CameraText* text) {
  text->note += (text->note.empty() ? "" : "; ") + note;
}

void cut(const YamlValues& values, const std::string& where, CameraText* text) {
  const int x = whole(values, "roi.x_offset", where), y = whole(values, "roi.y_offset", where);
  const Camera& camera = text->camera;
  int width = whole(values, "roi.width", where), height = whole(values, "roi.height", where);
  if (width == 0) width = camera.width - x;
  if (height == 0) height = camera.height - y;
  const bool is_whole = x == 0 && y == 0 && width == camera.width && height == camera.height;
  if (is_whole) return;
  if (!text->has_size() || width <= 0 || height <= 0 || x + width > camera.width ||
      y + height > camera.height)
    throw InputError(where, "the region of interest (roi) is not within the image",
                     "correct roi, width and height");
  add_note("of " + size_text(camera.width, camera.height) + " the region " + size_text(width, height) +
               " at " + std::to_string(x) + ", " + std::to_string(y) + " (roi)",
           text);
  text->camera = cut_camera(camera, x, y, width, height);
}

void bin(const YamlValues& values, const std::string& where, CameraText* text) {
  const int x = std::max(1, whole(values, "binning_x", where)),
            y = std::max(1, whole(values, "binning_y", where));
  if (x == 1 && y == 1) return;
  const Camera& camera = text->camera;
  if (camera.width < x || camera.height < y)
    throw InputError(where, "binning needs the image size", "give width and height");
  const int width = camera.width / x, height = camera.height / y;
  // Each pixel is the mean of x times y; those left over on the right and at the bottom are dropped.
  text->camera = scaled_camera(cut_camera(camera, 0, 0, width * x, height * y), width, height);
  add_note("binned to " + size_text(width, height), text);
}

}  // namespace

void apply_region(const YamlValues& values, const std::string& where, CameraText* text) {
  cut(values, where, text);
  bin(values, where, text);
}

}  // namespace edgevo
