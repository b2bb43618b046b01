// SPDX-License-Identifier: BSD-3-Clause
// COLMAP's cameras.txt: CAMERA_ID MODEL WIDTH HEIGHT PARAMS[] a line; and cameras.bin, little-endian: number
// of cameras (uint64), then for each id (uint32), model (int32), width, height (uint64) and its parameters
// (double).
#include <algorithm>
#include <cmath>
#include <cstring>

#include "colmap_models.h"
#include "edgevo/core/error.h"
#include "text_file.h"

namespace edgevo {
namespace {

bool is_word(const std::string& text) {
  return !text.empty() && text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ_") == std::string::npos;
}

ColmapCamera camera_of_line(const TextLine& line) {
  const auto fields = split_fields(line.text);
  if (fields.size() < 5)
    throw InputError(line.where, "is not CAMERA_ID MODEL WIDTH HEIGHT PARAMS[]", "restore the file");
  ColmapCamera camera;
  camera.model_name = fields[1];
  camera.width = parse_number(fields[2], line.where);
  camera.height = parse_number(fields[3], line.where);
  for (size_t i = 4; i < fields.size(); ++i) camera.params.push_back(parse_number(fields[i], line.where));
  return camera;
}

// ---- cameras.bin ----

constexpr uint64_t kMaxCameras = 1000000;

// Reads values in the byte order of the file, which is that of every machine that COLMAP runs on.
class Bytes {
 public:
  explicit Bytes(const std::string& text) : text_(text) {}

  // False at the end of the bytes.
  template <class Value>
  bool read(Value* value) {
    if (text_.size() - at_ < sizeof *value) return false;
    std::memcpy(value, text_.data() + at_, sizeof *value);
    at_ += sizeof *value;
    return true;
  }
  bool at_end() const { return at_ == text_.size(); }

 private:
  const std::string& text_;
  size_t at_ = 0;
};

struct BinaryHead {
  uint32_t id = 0;
  int32_t model = 0;
  uint64_t width = 0, height = 0;
};

bool read_head(Bytes* bytes, BinaryHead* h) {
  return bytes->read(&h->id) && bytes->read(&h->model) && bytes->read(&h->width) && bytes->read(&h->height);
}

ColmapCamera read_binary_camera(Bytes* bytes, BinaryHead* head, const std::string& where) {
  if (!read_head(bytes, head)) throw InputError(where, "COLMAP's cameras.bin ends early", "restore the file");
  const auto count = colmap_params(head->model);
  if (!count)  // without its length, the cameras behind it cannot be found either
    throw InputError(where, "COLMAP's model number " + std::to_string(head->model) + " is not known",
                     "export as text with COLMAP's model_converter");
  ColmapCamera camera;
  camera.model = head->model;
  camera.width = double(head->width), camera.height = double(head->height);
  camera.params.resize(*count);
  for (double& p : camera.params) {
    if (!bytes->read(&p)) throw InputError(where, "COLMAP's cameras.bin ends early", "restore the file");
    if (!std::isfinite(p)) throw InputError(where, "a parameter is not a finite number", "restore the file");
  }
  return camera;
}

}  // namespace

bool is_colmap_text(const std::string& text) {
  if (text.find('\0') != std::string::npos) return false;
  const auto lines = split_lines(text, "");
  if (lines.empty()) return false;
  const auto fields = split_fields(lines.front().text);
  const auto names = colmap_model_names();
  return fields.size() > 4 && fields[0].find_first_not_of("0123456789") == std::string::npos &&
         is_word(fields[1]) &&
         (std::count(names.begin(), names.end(), fields[1]) || text.find("CAMERA_ID") != std::string::npos);
}

NamedCameras colmap_text_cameras(const std::string& text, const std::string& where) {
  NamedCameras cameras;
  for (const TextLine& line : split_lines(text, where))
    cameras.push_back({split_fields(line.text).front(),
                       [line] { return colmap_camera(camera_of_line(line), line.where); }});
  return cameras;
}

bool is_colmap_binary(const std::string& text) {
  Bytes bytes(text);
  uint64_t count = 0;
  BinaryHead head;
  return bytes.read(&count) && count > 0 && count < kMaxCameras && read_head(&bytes, &head) &&
         head.model >= 0 && head.model < 100 && head.width > 0 && head.width < 1000000 && head.height > 0 &&
         head.height < 1000000;
}

NamedCameras colmap_binary_cameras(const std::string& text, const std::string& where) {
  Bytes bytes(text);
  uint64_t count = 0;
  bytes.read(&count);
  NamedCameras cameras;
  for (uint64_t i = 0; i < count; ++i) {
    BinaryHead head;
    const ColmapCamera camera = read_binary_camera(&bytes, &head, where);
    cameras.push_back({std::to_string(head.id), [camera, where] { return colmap_camera(camera, where); }});
  }
  if (!bytes.at_end()) throw InputError(where, "more follows behind the last camera", "restore the file");
  return cameras;
}

}  // namespace edgevo
