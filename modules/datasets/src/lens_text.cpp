// SPDX-License-Identifier: BSD-3-Clause
#include "lens_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

using Numbers = std::vector<double>;

struct LensName {
  LensKind kind;
  /// The first is the one that is written.
  std::vector<std::string> names;
  std::vector<std::string> coefficients;
};

const std::vector<LensName>& table() {
  static const std::vector<LensName> all{
      {LensKind::kPinhole, {"none", "pinhole", "pinhole-none"}, {}},
      {LensKind::kPlumbBob,
       {"plumb_bob", "radtan", "radial-tangential", "pinhole-radtan", "brown_conrady"},
       {"k1", "k2", "p1", "p2", "k3"}},
      {LensKind::kRational,
       {"rational_polynomial", "rational"},
       {"k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6", "s1", "s2", "s3", "s4"}},
      {LensKind::kKannalaBrandt,
       {"equidistant", "equi", "kannala_brandt", "kannalabrandt", "kannalabrandt8", "kb4", "kb8", "fisheye",
        "pinhole-equi"},
       {"k1", "k2", "k3", "k4"}},
      {LensKind::kFov, {"fov", "atan", "pinhole-fov"}, {"omega"}},
      {LensKind::kUnified, {"ucm", "unified"}, {"alpha"}},
      {LensKind::kExtendedUnified, {"eucm", "eucm-none", "extended_unified"}, {"alpha", "beta"}},
      {LensKind::kDoubleSphere, {"double_sphere", "ds", "ds-none"}, {"xi", "alpha"}},
      {LensKind::kOmni, {"omni", "mei", "omni-radtan", "omni-none"}, {"xi", "k1", "k2", "p1", "p2"}}};
  return all;
}

const LensName& entry(LensKind kind) {
  return *std::find_if(table().begin(), table().end(), [&](const LensName& e) { return e.kind == kind; });
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

[[noreturn]] void fail_count(const StatedLens& lens, const std::string& where) {
  const size_t count = lens.coefficients.size();
  throw InputError(where,
                   "the lens " + name_of(lens.kind) + " has " + std::to_string(count) +
                       (count == 1 ? " coefficient" : " coefficients"),
                   "write " + joined(coefficient_names(lens.kind)));
}

// With zeros for those that are missing, without zeros beyond `most`.
void require(StatedLens* lens, std::initializer_list<size_t> counts, size_t most, const std::string& where) {
  Numbers& k = lens->coefficients;
  const bool allowed = std::count(counts.begin(), counts.end(), k.size()) > 0;
  while (k.size() > most && k.back() == 0) k.pop_back();
  if (k.size() > most || (!allowed && k.size() != most)) fail_count(*lens, where);
  k.resize(most, 0.0);
}

// The focal length of a formula, times this, is that on the axis.
Intrinsics on_axis(const Intrinsics& i, double scale) { return {scale * i.fx, scale * i.fy, i.cx, i.cy}; }

double fov_scale(double omega) { return 2 * std::tan(omega / 2) / omega; }

double positive(double value, const std::string& where) {
  if (!(value > 0) || !std::isfinite(value))
    throw InputError(where, "xi is not above -1",
                     "check the coefficients, whose order is xi, alpha or xi, k1");
  return value;
}

CameraModel fov_model(const Intrinsics& stated, double omega, const std::string& where) {
  if (omega == 0) return PinholeModel{stated};
  if (!(omega > 0 && omega < M_PI))
    throw InputError(where, "the angle of the FOV lens is not between 0 and pi", "give it in radians");
  return FovModel{on_axis(stated, fov_scale(omega)), omega};
}

// The coefficients of OpenCV's longest form less the tilted sensor, which is not read.
Numbers rational_coefficients(const StatedLens& lens, const std::string& where) {
  Numbers k = lens.coefficients;
  while (k.size() > 5 && k.back() == 0) k.pop_back();
  const size_t stated = k.size() <= 5 ? k.size() : lens.coefficients.size();
  if (k.size() > 12 && stated == 14)
    throw InputError(where, "the sensor is tilted (tau_x, tau_y), which is not supported",
                     "calibrate without CALIB_TILTED_MODEL");
  static const std::vector<size_t> counts{0, 4, 5, 8, 12, 14};
  if (!std::count(counts.begin(), counts.end(), stated)) fail_count(lens, where);
  k.resize(12, 0.0);
  return k;
}

CameraModel rational_model(const StatedLens& lens, const std::string& where) {
  const Numbers k = rational_coefficients(lens, where);
  const Distortion d{k[0], k[1], k[2], k[3], k[4]};
  if (std::any_of(k.begin() + 5, k.end(), [](double v) { return v != 0; }))
    return RationalModel{lens.intrinsics, {d, k[5], k[6], k[7], k[8], k[9], k[10], k[11]}};
  if (d.is_zero()) return PinholeModel{lens.intrinsics};
  return PlumbBobModel{lens.intrinsics, d};
}

// ---- from models ----

StatedLens stated(const PinholeModel& m) { return {LensKind::kPinhole, m, {}}; }

Numbers coefficients_of(const Distortion& d) { return {d.k1, d.k2, d.p1, d.p2, d.k3}; }

StatedLens stated(const PlumbBobModel& m) { return {LensKind::kPlumbBob, m, coefficients_of(m.distortion)}; }

StatedLens stated(const RationalModel& m) {
  const RationalDistortion& d = m.distortion;
  StatedLens lens{LensKind::kRational, m, coefficients_of(d.plumb_bob)};
  for (const double k : {d.k4, d.k5, d.k6}) lens.coefficients.push_back(k);
  if (d.s1 != 0 || d.s2 != 0 || d.s3 != 0 || d.s4 != 0)
    for (const double s : {d.s1, d.s2, d.s3, d.s4}) lens.coefficients.push_back(s);
  return lens;
}

StatedLens stated(const KannalaBrandtModel& m) {
  return {LensKind::kKannalaBrandt, m, {m.k1, m.k2, m.k3, m.k4}};
}

StatedLens stated(const FovModel& m) {
  return {LensKind::kFov, on_axis(m, 1 / fov_scale(m.omega)), {m.omega}};
}

StatedLens stated(const ExtendedUnifiedModel& m) {
  return {LensKind::kExtendedUnified, m, {m.alpha, m.beta}};
}

StatedLens stated(const DoubleSphereModel& m) {
  return {LensKind::kDoubleSphere, on_axis(m, 1 + m.xi), {m.xi, m.alpha}};
}

StatedLens stated(const OmniModel& m) {
  const Distortion& d = m.distortion;
  return {LensKind::kOmni, on_axis(m, 1 + m.xi), {m.xi, d.k1, d.k2, d.p1, d.p2}};
}

}  // namespace

std::string name_of(LensKind kind) { return entry(kind).names.front(); }

std::optional<LensKind> lens_of_name(const std::string& name) {
  std::string lower = name;
  for (char& c : lower) c = char(std::tolower(static_cast<unsigned char>(c)));
  for (const LensName& lens : table())
    if (std::count(lens.names.begin(), lens.names.end(), lower)) return lens.kind;
  return std::nullopt;
}

const std::vector<std::string>& lens_names() {
  static const std::vector<std::string> all = [] {
    std::vector<std::string> names;
    for (const LensName& lens : table()) names.insert(names.end(), lens.names.begin(), lens.names.end());
    return names;
  }();
  return all;
}

std::vector<std::string> coefficient_names(LensKind kind) { return entry(kind).coefficients; }

CameraModel model_of(StatedLens lens, const std::string& where) {
  const Intrinsics i = lens.intrinsics;
  Numbers& k = lens.coefficients;
  switch (lens.kind) {
    case LensKind::kPinhole:
      if (std::any_of(k.begin(), k.end(), [](double v) { return v != 0; }))
        throw InputError(where, "the lens has no distortion, but coefficients follow", "name their model");
      return PinholeModel{i};
    case LensKind::kPlumbBob:
      require(&lens, {0, 4, 5}, 5, where);
      return rational_model(lens, where);
    case LensKind::kRational:
      return rational_model(lens, where);
    case LensKind::kKannalaBrandt:
      require(&lens, {4}, 4, where);
      return KannalaBrandtModel{i, k[0], k[1], k[2], k[3]};
    case LensKind::kFov:
      require(&lens, {1}, 1, where);
      return fov_model(i, k[0], where);
    case LensKind::kUnified:
      require(&lens, {1}, 1, where);
      return ExtendedUnifiedModel{i, k[0], 1};
    case LensKind::kExtendedUnified:
      require(&lens, {2}, 2, where);
      return ExtendedUnifiedModel{i, k[0], k[1]};
    case LensKind::kDoubleSphere:
      require(&lens, {2}, 2, where);
      return DoubleSphereModel{on_axis(i, 1 / positive(1 + k[0], where)), k[0], k[1]};
    case LensKind::kOmni:
      require(&lens, {1, 5}, 5, where);
      return OmniModel{on_axis(i, 1 / positive(1 + k[0], where)), k[0], {k[1], k[2], k[3], k[4], 0}};
  }
  throw InputError(where, "the lens is not known", "");
}

StatedLens stated_lens(const CameraModel& model) {
  return std::visit([](const auto& m) { return stated(m); }, model);
}

}  // namespace edgevo
