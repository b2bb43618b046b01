// SPDX-License-Identifier: BSD-3-Clause
// Cameras of CamOdoCal in YAML, as VINS and KITTI-360 have them: model_type PINHOLE, MEI or KANNALA_BRANDT,
// with projection_parameters, distortion_parameters and mirror_parameters.
#include "camera_numbers.h"
#include "dialect.h"
#include "edgevo/core/error.h"
#include "text_file.h"

namespace edgevo {
namespace {

using Keys = std::vector<std::string>;

struct Model {
  const char* name;
  LensKind kind;
  /// Dotted keys, in the order of StatedLens.
  Keys intrinsics, coefficients;
};

const std::vector<Model>& models() {
  static const std::vector<Model> all{
      {"PINHOLE",
       LensKind::kPlumbBob,
       {"projection_parameters.fx", "projection_parameters.fy", "projection_parameters.cx",
        "projection_parameters.cy"},
       {"distortion_parameters.k1", "distortion_parameters.k2", "distortion_parameters.p1",
        "distortion_parameters.p2"}},
      {"MEI",
       LensKind::kOmni,
       {"projection_parameters.gamma1", "projection_parameters.gamma2", "projection_parameters.u0",
        "projection_parameters.v0"},
       {"mirror_parameters.xi", "distortion_parameters.k1", "distortion_parameters.k2",
        "distortion_parameters.p1", "distortion_parameters.p2"}},
      {"KANNALA_BRANDT",
       LensKind::kKannalaBrandt,
       {"projection_parameters.mu", "projection_parameters.mv", "projection_parameters.u0",
        "projection_parameters.v0"},
       {"projection_parameters.k2", "projection_parameters.k3", "projection_parameters.k4",
        "projection_parameters.k5"}}};
  return all;
}

double number(const YamlValues& values, const std::string& key, const std::string& where) {
  const auto all = yaml_numbers(values, {key}, where);
  if (all.size() != 1) throw InputError(where, quote(key) + " is missing", "restore the file");
  return all.front();
}

CameraText read_camera(const YamlValues& values, const std::string& where) {
  const YamlValue& type = values.at("model_type");
  const std::string name = type.texts.empty() ? "" : type.texts.front();
  for (const Model& model : models()) {
    if (name != model.name) continue;
    std::vector<double> i;
    for (const std::string& key : model.intrinsics) i.push_back(number(values, key, where));
    StatedLens lens{model.kind, {i[0], i[1], i[2], i[3]}, {}};
    for (const std::string& key : model.coefficients) lens.coefficients.push_back(number(values, key, where));
    return camera_of_lens(std::move(lens), image_side(number(values, "image_width", where), where),
                          image_side(number(values, "image_height", where), where), where);
  }
  throw InputError(where, "CamOdoCal's model_type " + quote(name) + " is not supported",
                   "calibrate as KANNALA_BRANDT or MEI");
}

}  // namespace

bool is_camodocal(const YamlValues& values) { return values.count("model_type") > 0; }

NamedCameras camodocal_cameras(const YamlValues& values, const std::string& where) {
  return {{"camera", [values, where] { return read_camera(values, where); }}};
}

}  // namespace edgevo
