// SPDX-License-Identifier: BSD-3-Clause
#include "camera_yaml_lens.h"

#include <algorithm>

#include "camera_keys.h"
#include "edgevo/core/error.h"
#include "edgevo/core/suggestion.h"
#include "lens_text.h"
#include "text_file.h"

namespace edgevo {
namespace {

// ---- names ----

std::string first_text(const YamlValues& values, const std::string& key) {
  const auto it = values.find(key);
  return it == values.end() || it->second.texts.empty() ? std::string() : it->second.texts.front();
}

// The lens that a key names; nullopt if the file does not have it.
std::optional<LensKind> named_lens(const YamlValues& values, const std::string& key,
                                   const std::string& where) {
  const std::string name = first_text(values, key);
  if (name.empty()) return std::nullopt;
  if (const auto kind = lens_of_name(name)) return kind;
  const std::string suggestion = did_you_mean(name, lens_names());
  throw InputError(where, key + " " + quote(name) + " is not supported",
                   suggestion.empty() ? "calibrate as one of plumb_bob, rational_polynomial, equidistant "
                                        "(fisheye), fov, eucm, double_sphere, omni"
                                      : suggestion);
}

// The lens of OpenCV's files that say so without a name.
std::optional<LensKind> lens_of_opencv(const YamlValues& values, const std::string& where) {
  if (!only_key(values, {"xi"}, where).empty()) return LensKind::kOmni;
  const std::string fisheye = first_text(values, "fisheye_model");
  if (fisheye == "1" || fisheye == "true") return LensKind::kKannalaBrandt;
  if (fisheye.empty() || fisheye == "0" || fisheye == "false") return std::nullopt;
  throw InputError(where, "fisheye_model " + quote(fisheye) + " is neither 0 nor 1", "correct it");
}

[[noreturn]] void refuse_pair(const std::string& where, const std::string& a, const std::string& b,
                              const std::string& remedy) {
  throw InputError(where, a + " does not go with " + b, remedy);
}

// The lens of a projection and a distortion, as Kalibr names both: some pairs are one model.
LensKind joined_lens(LensKind projection, LensKind distortion, const std::string& where) {
  if (projection == distortion || distortion == LensKind::kPinhole) return projection;
  if (projection == LensKind::kPinhole) return distortion;
  if (projection == LensKind::kOmni && distortion == LensKind::kPlumbBob) return projection;
  refuse_pair(where, "distortion_model " + name_of(distortion), "camera_model " + name_of(projection),
              projection == LensKind::kOmni ? "calibrate as omni-radtan or pinhole-equi"
                                            : "calibrate without distortion_model, or as pinhole-equi");
}

// Without any name, the number of coefficients says whether they are plumb-bob or rational.
LensKind kind_of_yaml(const YamlValues& values, const std::string& where) {
  const LensKind projection = named_lens(values, "camera_model", where).value_or(LensKind::kPinhole);
  const auto distortion = named_lens(values, "distortion_model", where);
  const auto opencv = lens_of_opencv(values, where);
  if (!distortion)
    return projection != LensKind::kPinhole ? projection : opencv.value_or(LensKind::kRational);
  const LensKind kind = joined_lens(projection, *distortion, where);
  if (opencv && *opencv != kind)
    refuse_pair(where, *opencv == LensKind::kOmni ? "xi" : "fisheye_model 1",
                "distortion_model " + name_of(kind), "correct distortion_model");
  return kind;
}

// ---- numbers ----

// How Kalibr lists what belongs to a projection.
const char* intrinsics_order(LensKind projection) {
  switch (projection) {
    case LensKind::kOmni:
      return "xi, fx, fy, cx, cy";
    case LensKind::kDoubleSphere:
      return "xi, alpha, fx, fy, cx, cy";
    case LensKind::kExtendedUnified:
      return "alpha, beta, fx, fy, cx, cy";
    case LensKind::kUnified:
      return "alpha, fx, fy, cx, cy";
    default:
      return "fx, fy, cx, cy";
  }
}

size_t count_names(const std::string& list) { return size_t(std::count(list.begin(), list.end(), ',')) + 1; }

void read_intrinsics(const YamlValues& values, const std::string& where, StatedLens* lens) {
  const LensKind projection = named_lens(values, "camera_model", where).value_or(LensKind::kPinhole);
  const std::string order = intrinsics_order(projection);
  const auto all = numbers_of(values, {"intrinsics"}, where);
  if (all.size() != count_names(order)) fail_count(where, "intrinsics", all.size(), order);
  const auto pinhole = all.end() - 4;
  lens->coefficients.assign(all.begin(), pinhole);
  lens->intrinsics = {pinhole[0], pinhole[1], pinhole[2], pinhole[3]};
}

void read_matrix(const YamlValues& values, const std::string& where, StatedLens* lens) {
  const auto m = numbers_of(values, camera_matrix_keys(), where);
  if (m.empty())
    throw InputError(where, "camera_matrix is missing (Kalibr: intrinsics)",
                     "give it as 3x3 numbers, row by row");
  if (m.size() != 9) fail_count(where, "camera_matrix", m.size(), "3x3 numbers, row by row");
  if (m[1] != 0 || m[3] != 0 || m[6] != 0 || m[7] != 0 || m[8] != 1)
    throw InputError(where, "camera_matrix is not [fx 0 cx, 0 fy cy, 0 0 1]", "calibrate without skew");
  lens->intrinsics = {m[0], m[4], m[2], m[5]};
  lens->coefficients = numbers_of(values, {"xi"}, where);
}

}  // namespace

void check_lens_names(const YamlValues& values, const std::string& where) { kind_of_yaml(values, where); }

CameraModel lens_of_yaml(const YamlValues& values, const std::string& where) {
  StatedLens lens;
  lens.kind = kind_of_yaml(values, where);
  std::vector<std::string> either = camera_matrix_keys();
  either.push_back("intrinsics");
  if (only_key(values, either, where) == "intrinsics")
    read_intrinsics(values, where, &lens);
  else
    read_matrix(values, where, &lens);
  const auto distortion = numbers_of(values, distortion_keys(), where);
  lens.coefficients.insert(lens.coefficients.end(), distortion.begin(), distortion.end());
  return model_of(std::move(lens), where);
}

}  // namespace edgevo
