// SPDX-License-Identifier: BSD-3-Clause
// camera.txt of DSO and of the TUM monoVO data set: the lens with fx fy cx cy and its coefficients, the size
// of the images, then how DSO rectifies them, which is not followed. Focal lengths and principal point are
// shares of the size where the latter is below 1.
#include <algorithm>

#include "camera_numbers.h"
#include "dialect.h"
#include "edgevo/core/error.h"
#include "text_file.h"

namespace edgevo {
namespace {

struct DsoLens {
  const char* name;
  LensKind kind;
};

constexpr DsoLens kLenses[] = {{"Pinhole", LensKind::kFov},
                               {"FOV", LensKind::kFov},
                               {"ATAN", LensKind::kFov},
                               {"RadTan", LensKind::kPlumbBob},
                               {"EquiDistant", LensKind::kKannalaBrandt},
                               {"KannalaBrandt", LensKind::kKannalaBrandt}};

const DsoLens* lens_of(const std::string& word) {
  const auto it = std::find_if(std::begin(kLenses), std::end(kLenses),
                               [&](const DsoLens& lens) { return word == lens.name; });
  return it == std::end(kLenses) ? nullptr : it;
}

// The corner of the image is 0 in shares, here its first pixel's centre.
void make_absolute(double width, double height, Intrinsics* i) {
  if (!(i->cx < 1 && i->cy < 1)) return;
  i->fx *= width, i->fy *= height;
  i->cx = i->cx * width - 0.5, i->cy = i->cy * height - 0.5;
}

// Without a name: five numbers are an FOV lens, of which angle 0 is a pinhole, eight are RadTan.
StatedLens first_line(const TextLine& line) {
  auto fields = split_fields(line.text);
  const DsoLens* lens = lens_of(fields[0]);
  if (lens)
    fields.erase(fields.begin());
  else
    lens = lens_of(fields.size() == 8 ? "RadTan" : "FOV");
  const bool is_fov = lens->kind == LensKind::kFov;
  const size_t count = is_fov ? 5 : 8;
  if (fields.size() != count)
    throw InputError(line.where, "has " + std::to_string(fields.size()) + " numbers",
                     std::string("write DSO's ") + lens->name + " fx fy cx cy " +
                         (is_fov                              ? "omega"
                          : lens->kind == LensKind::kPlumbBob ? "k1 k2 p1 p2"
                                                              : "k1 k2 k3 k4"));
  std::vector<double> v;
  for (const std::string& field : fields) v.push_back(parse_number(field, line.where));
  StatedLens stated{lens->kind, {v[0], v[1], v[2], v[3]}, {}};
  stated.coefficients.assign(v.begin() + 4, v.end());
  return stated;
}

CameraText read_lines(const std::vector<TextLine>& lines) {
  StatedLens lens = first_line(lines[0]);
  const auto size = parse_numbers(lines[1], 2, "width and height");
  const int width = image_side(size[0], lines[1].where), height = image_side(size[1], lines[1].where);
  make_absolute(width, height, &lens.intrinsics);
  CameraText text = camera_of_lens(std::move(lens), width, height, lines[0].where);
  text.note = "DSO's camera.txt; how it cuts and scales the images is not followed";
  return text;
}

}  // namespace

bool is_dso(const std::string& text) {
  if (text.find('\0') != std::string::npos) return false;
  const auto lines = split_lines(text, "");
  if (lines.size() < 2 || split_fields(lines[1].text).size() != 2) return false;
  if (lines[0].text.find(':') != std::string::npos) return false;  // YAML
  const auto first = split_fields(lines[0].text);
  return lens_of(first[0]) || first.size() == 5 || first.size() == 8;
}

NamedCameras dso_cameras(const std::string& text, const std::string& where) {
  return {{"camera", [lines = split_lines(text, where)] { return read_lines(lines); }}};
}

}  // namespace edgevo
