// SPDX-License-Identifier: BSD-3-Clause
// MRPT's .ini files of a camera or a stereo pair, as its calibration tools write them: a section
// [CAMERA_PARAMS...] with `resolution = [W H]`, fx, fy, cx, cy and `dist = [k1 k2 t1 t2 k3 ...]`, for a
// fisheye [k1 k2 * * k3 k4].
#include <algorithm>
#include <map>

#include "camera_numbers.h"
#include "dialect.h"
#include "edgevo/core/error.h"
#include "edgevo/core/suggestion.h"
#include "text_file.h"

namespace edgevo {
namespace {

constexpr const char* kSection = "[CAMERA_PARAMS";

struct IniValue {
  std::string text, where;
};
using Section = std::map<std::string, IniValue>;

const std::vector<std::string>& ini_keys() {
  static const std::vector<std::string> keys{
      "resolution",      "fx",       "fy", "cx", "cy", "dist", "distortion", "camera_name", "focal_length",
      "pose_quaternion", "pose_pose"};
  return keys;
}

std::string without_ini_comment(const std::string& line) {
  return line.substr(0, std::min(line.find("//"), line.find(';')));
}

// "[1 2 3]", "1, 2, 3" or "1".
std::vector<double> numbers(const IniValue& value) {
  std::string text = value.text;
  for (char& c : text)
    if (c == '[' || c == ']' || c == ',') c = ' ';
  std::vector<double> all;
  for (const std::string& field : split_fields(text)) all.push_back(parse_number(field, value.where));
  return all;
}

void add_entry(const TextLine& line, Section* section) {
  const std::string text = without_ini_comment(line.text);
  if (split_fields(text).empty()) return;
  const size_t equals = text.find('=');
  const auto key = split_fields(text.substr(0, equals));
  if (equals == std::string::npos || key.size() != 1)
    throw InputError(line.where, "is not `key = value`", "correct it");
  if (!std::count(ini_keys().begin(), ini_keys().end(), key[0])) {
    const std::string suggestion = did_you_mean(key[0], ini_keys());
    throw InputError(line.where, "unknown key " + quote(key[0]),
                     suggestion.empty() ? "remove it if it does not belong to the camera" : suggestion);
  }
  if (!section->emplace(key[0], IniValue{text.substr(equals + 1), line.where}).second)
    throw InputError(line.where, "the key " + quote(key[0]) + " is given twice", "keep one");
}

std::vector<double> needed(const Section& section, const char* key, size_t count, const std::string& where) {
  const auto it = section.find(key);
  if (it == section.end()) throw InputError(where, quote(key) + " is missing", "restore the file");
  auto all = numbers(it->second);
  if (all.size() != count)
    throw InputError(it->second.where, std::string(key) + " holds " + std::to_string(all.size()) + " numbers",
                     "write " + std::to_string(count));
  return all;
}

std::string distortion_name(const Section& section) {
  const auto it = section.find("distortion");
  if (it == section.end()) return "plumb_bob";
  const auto fields = split_fields(it->second.text);
  return fields.empty() ? "" : fields[0];
}

StatedLens distortion_of(const Section& section, const std::string& where) {
  const auto it = section.find("dist");
  std::vector<double> k = it == section.end() ? std::vector<double>() : numbers(it->second);
  const std::string name = distortion_name(section);
  StatedLens lens;
  if (name == "none") return lens;
  if (name == "kannala_brandt") {
    if (k.size() < 6) throw InputError(where, "dist is not [k1 k2 0 0 k3 k4]", "correct it");
    lens.kind = LensKind::kKannalaBrandt;
    lens.coefficients = {k[0], k[1], k[4], k[5]};
    return lens;
  }
  if (name != "plumb_bob")
    throw InputError(where, "MRPT's distortion " + quote(name) + " is not supported",
                     "it has none, plumb_bob and kannala_brandt");
  lens.kind = LensKind::kRational;  // of which plumb-bob is the short form
  lens.coefficients = k;
  return lens;
}

CameraText read_section(const Section& section, const std::string& where) {
  StatedLens lens = distortion_of(section, where);
  lens.intrinsics = {needed(section, "fx", 1, where)[0], needed(section, "fy", 1, where)[0],
                     needed(section, "cx", 1, where)[0], needed(section, "cy", 1, where)[0]};
  const auto size = needed(section, "resolution", 2, where);
  return camera_of_lens(std::move(lens), image_side(size[0], where), image_side(size[1], where), where);
}

}  // namespace

bool is_mrpt_ini(const std::string& text) { return text.find(kSection) != std::string::npos; }

NamedCameras mrpt_ini_cameras(const std::string& text, const std::string& where) {
  NamedCameras cameras;
  std::vector<std::pair<std::string, Section>> sections;
  bool is_camera = false;
  for (const TextLine& line : split_lines(text, where)) {
    if (line.text.front() == '[') {
      const std::string name = line.text.substr(1, line.text.find(']') - 1);
      is_camera = begins_with(line.text, kSection) && name.find("POSE") == std::string::npos;
      if (is_camera) sections.emplace_back(name, Section());
    } else if (is_camera) {
      add_entry(line, &sections.back().second);
    }
  }
  for (const auto& [name, section] : sections)
    cameras.push_back({name, [section = section, place = where + ", [" + name + "]"] {
                         return read_section(section, place);
                       }});
  return cameras;
}

}  // namespace edgevo
