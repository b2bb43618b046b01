// SPDX-License-Identifier: BSD-3-Clause
#include "camera_forms.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "camera_numbers.h"
#include "edgevo/core/error.h"
#include "text_file.h"

namespace edgevo {
namespace {

using TextLines = std::vector<TextLine>;

// Format of camera.txt, for messages.
constexpr const char* kNumbersFormat = "fx fy cx cy k1 k2 p1 p2 width height [k3]";

bool contains(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

Pinhole pinhole_of_matrix(const std::vector<double>& m, const std::string& where) {
  if (m[1] != 0 || m[3] != 0 || m[6] != 0 || m[7] != 0 || m[8] != 1)
    throw InputError(where, "the matrix is not [fx 0 cx, 0 fy cy, 0 0 1]", "calibrate without skew");
  return {m[0], m[4], m[2], m[5], 0, 0};
}

// ---- one line of numbers ----

bool is_matrix(const std::vector<double>& v) {
  return v.size() == 9 && v[1] == 0 && v[3] == 0 && v[6] == 0 && v[7] == 0 && v[8] == 1;
}

// k3 is a fraction; a whole number of this size is a width whose height is missing.
bool is_width(double value) { return value >= 16 && value == std::floor(value); }

CameraText parse_line(const TextLine& line) {
  if (contains(line.text, ","))
    throw InputError(line.where, "has commas", "write decimal points, and blanks between the numbers");
  const size_t count = split_fields(line.text).size();
  CameraText text;
  if (count == 4 || count == 8 || count == 9) {
    auto v = parse_numbers(line, count, kNumbersFormat);
    if (is_matrix(v)) {
      text.camera = Camera(pinhole_of_matrix(v, line.where));
      return text;
    }
    if (count == 9 && is_width(v[8])) parse_numbers(line, 10, kNumbersFormat);  // throws
    v.resize(9, 0.0);
    text.camera = Camera({v[0], v[1], v[2], v[3], 0, 0}, {v[4], v[5], v[6], v[7], v[8]});
    return text;
  }
  const auto v = parse_numbers(line, count == 11 ? 11 : 10, kNumbersFormat);
  text.camera = Camera({v[0], v[1], v[2], v[3], image_side(v[8], line.where), image_side(v[9], line.where)},
                       {v[4], v[5], v[6], v[7], count == 11 ? v[10] : 0.0});
  return text;
}

// ---- a 3x3 matrix ----

bool is_matrix_file(const TextLines& lines) {
  return lines.size() == 3 && std::all_of(lines.begin(), lines.end(), [](const TextLine& line) {
           return split_fields(line.text).size() == 3;
         });
}

CameraText parse_matrix_file(const TextLines& lines) {
  std::vector<double> m;
  for (const TextLine& line : lines)
    for (const double value : parse_numbers(line, 3, "three numbers")) m.push_back(value);
  CameraText text;
  text.camera = Camera(pinhole_of_matrix(m, lines.front().where));
  return text;
}

// ---- ROS's ost.txt and .ini ----

bool is_ost(const TextLines& lines) {
  return std::any_of(lines.begin(), lines.end(), [](const TextLine& line) { return line.text == "[image]"; });
}

// Headings, each with the lines of numbers below it; a second camera repeats them.
class OstFile {
 public:
  OstFile(const TextLines& lines, std::string where) : lines_(lines), where_(std::move(where)) {}

  // The numbers below `heading`: `rows` lines of `cols`. Nullopt if there is no such heading.
  std::optional<std::vector<double>> numbers(const char* heading, size_t rows, size_t cols) const {
    const auto is_it = [&](const TextLine& line) { return line.text == heading; };
    const auto it = std::find_if(lines_.begin(), lines_.end(), is_it);
    if (it == lines_.end()) return std::nullopt;
    if (std::find_if(it + 1, lines_.end(), is_it) != lines_.end())
      throw InputError(where_, "several cameras", "keep the one that took the images");
    if (size_t(lines_.end() - it) <= rows) throw InputError(it->where, "ends too early", "restore the file");
    std::vector<double> all;
    for (size_t i = 0; i < rows; ++i)
      for (const double v : parse_numbers(it[long(i) + 1], cols, std::to_string(cols) + " numbers"))
        all.push_back(v);
    return all;
  }
  std::vector<double> needed(const char* heading, size_t rows, size_t cols) const {
    const auto found = numbers(heading, rows, cols);
    if (!found) throw InputError(where_, std::string("has no '") + heading + "'", "restore the file");
    return *found;
  }

 private:
  const TextLines& lines_;
  std::string where_;
};

CameraText parse_ost(const TextLines& lines, const std::string& where) {
  const OstFile file(lines, where);
  Pinhole p = pinhole_of_matrix(file.needed("camera matrix", 3, 3), where);
  p.width = image_side(file.needed("width", 1, 1)[0], where);
  p.height = image_side(file.needed("height", 1, 1)[0], where);
  const auto d = file.needed("distortion", 1, 5);
  CameraText text;
  text.camera = Camera(p, {d[0], d[1], d[2], d[3], d[4]});
  return text;
}

}  // namespace

CameraText parse_camera_numbers(const std::string& text, const std::string& where) {
  const TextLines lines = split_lines(text, where);
  if (lines.empty()) throw InputError(where, "holds no calibration", std::string("write ") + kNumbersFormat);
  if (is_ost(lines)) return parse_ost(lines, where);
  if (is_matrix_file(lines)) return parse_matrix_file(lines);
  if (lines.size() > 1 && split_fields(lines[0].text).size() != split_fields(lines[1].text).size())
    throw InputError(lines[1].where, "is no part of a calibration of a known form", kWriteNumbers);
  if (lines.size() > 1) throw InputError(lines[1].where, "a second calibration follows", "keep one line");
  return parse_line(lines[0]);
}

// Width and height of another orientation than the matrix.
void refuse_swapped_size(const Pinhole& p, const std::string& where) {
  const bool is_outside = p.cx >= p.width || p.cy >= p.height;
  if (!is_outside || !(p.cx > 0 && p.cy > 0 && p.cx < p.height && p.cy < p.width)) return;
  const auto text = [](int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
  };
  throw InputError(
      where,
      "the matrix is one of " + text(p.height, p.width) + " images, the size is " + text(p.width, p.height),
      "exchange width and height, or give the calibration of upright images");
}

void check_camera_text(const CameraText& text, const std::string& where) {
  Camera camera = text.camera;
  if (text.has_size()) refuse_swapped_size(camera.pinhole(), where);
  if (!text.has_size()) camera.width = camera.height = kLargestSide;
  camera.check(where);
}

}  // namespace edgevo
