// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/camera_file.h"

#include <cmath>
#include <filesystem>

#include "camera_fit.h"
#include "camera_forms.h"
#include "camera_numbers.h"
#include "camera_yaml.h"
#include "dialects/colmap_database.h"
#include "dialects/dialect.h"
#include "edgevo/core/error.h"
#include "text_file.h"

namespace edgevo {
namespace {

bool is_yaml(const std::string& text, const std::string& where) {
  for (const TextLine& line : split_lines(text, where))
    if (line.text.find(':') != std::string::npos || line.text[0] == '%') return true;
  return false;
}

CameraText checked(CameraText text, const std::string& where) {
  check_camera_text(text, where);
  return text;
}

// What begins an image by mistake given as the calibration; nullptr: it is none.
const char* image_format(const std::string& text) {
  if (begins_with(text, "\x89PNG")) return "a PNG image";
  if (begins_with(text, "\xff\xd8\xff")) return "a JPEG image";
  if (begins_with(text, "P5") || begins_with(text, "P6")) return "a PNM image";
  if (begins_with(text, "II*") || begins_with(text, "MM")) return "a TIFF image";
  return nullptr;
}

void refuse_binary(const std::string& text, const std::string& where) {
  const bool is_binary = text.find('\0') != std::string::npos;
  const char* const format = is_binary ? image_format(text) : nullptr;
  if (!is_binary) return;
  throw InputError(where, std::string("is ") + (format ? format : "not text") + ", not a calibration",
                   "give the camera file, and the images as SOURCE");
}

NamedCameras cameras_of_text(const std::string& text, const std::string& where) {
  if (const Dialect* dialect = dialect_of(text)) return dialect->cameras(text, where);
  refuse_binary(text, where);
  if (!is_yaml(text, where))
    return {{"camera", [=] { return checked(parse_camera_numbers(text, where), where); }}};
  const auto documents = parse_yaml_documents(text, where);
  if (documents.size() == 1)
    if (const YamlDialect* dialect = dialect_of(documents.front()))
      return dialect->cameras(documents.front(), where);
  return {{"camera", [=] { return camera_of_yaml_documents(documents, where); }}};
}

// The numbers of a camera themselves, in place of a file of them.
bool is_of_numbers(const std::string& text) {
  return text.find(' ') != std::string::npos &&
         text.find_first_not_of("0123456789+-.eE \t") == std::string::npos;
}

std::string text_of(const std::string& path_or_numbers) {
  return is_of_numbers(path_or_numbers) ? path_or_numbers : read_text_file(path_or_numbers);
}

// A folder is one of COLMAP: the reconstruction, or what it lies in. The database has its initial guess
// alone.
std::string file_in(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (!fs::is_directory(path, error)) return path;
  for (const char* name : {"cameras.txt", "cameras.bin", "database.db"})
    for (const char* below : {"", "0", "sparse/0", "sparse"})
      if (const fs::path file = fs::path(path) / below / name; fs::is_regular_file(file, error))
        return file.string();
  throw InputError(path, "is a folder without COLMAP's cameras.txt, cameras.bin or database.db",
                   "give the camera file itself");
}

NamedCameras cameras_of_file(const std::string& path_or_folder) {
  const std::string path = file_in(path_or_folder);
  if (is_sqlite_file(path)) return colmap_database_cameras(path);
  return cameras_of_text(text_of(path), path);
}

// What a file of our own says besides the camera; others say nothing.
template <class Value>
std::optional<Value> read_own_key(const std::string& path_or_folder,
                                  std::optional<Value> (*parse)(const std::string&, const std::string&)) {
  const std::string path = file_in(path_or_folder);
  if (is_sqlite_file(path)) return std::nullopt;
  const std::string text = text_of(path);
  return !dialect_of(text) && is_yaml(text, path) ? parse(text, path) : std::nullopt;
}

Camera with_size(const CameraText& text, const std::string& where) {
  if (!text.has_size())
    throw InputError(where, "the image size is missing", "give image_width and image_height in pixels");
  return text.camera;
}

}  // namespace

int image_side(double value, const std::string& where) {
  if (!(value >= 1 && value <= kLargestSide) || value != std::floor(value))
    throw InputError(
        where, "the image size is not a whole number of pixels from 1 to " + std::to_string(kLargestSide),
        "give width and height in pixels");
  return int(value);
}

CameraText parse_camera_text(const std::string& text, const std::string& where, const std::string& sensor) {
  return chosen_camera(cameras_of_text(text, where), sensor, where);
}

CameraText read_camera_text(const std::string& path, const std::string& sensor) {
  return chosen_camera(cameras_of_file(path), sensor, path);
}

bool has_several_cameras(const std::string& path) { return cameras_of_file(path).size() > 1; }

Camera parse_camera(const std::string& text, const std::string& where, const std::string& sensor) {
  return with_size(parse_camera_text(text, where, sensor), where);
}

Camera read_camera_file(const std::string& path, const std::string& sensor) {
  return with_size(read_camera_text(path, sensor), path);
}

std::optional<CameraMount> read_camera_mount(const std::string& path) {
  return read_own_key(path, parse_yaml_mount);
}

std::optional<GyroModel> read_camera_gyro(const std::string& path) {
  return read_own_key(path, parse_yaml_gyro);
}

}  // namespace edgevo
