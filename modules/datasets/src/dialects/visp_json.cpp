// SPDX-License-Identifier: BSD-3-Clause
// ViSP's cameras in JSON: px, py, u0, v0 and a model; with distortion also kud and kdu. The size is not in
// the file.
#include "camera_numbers.h"
#include "dialect.h"
#include "edgevo/core/error.h"
#include "shallow_json.h"
#include "text_file.h"

namespace edgevo {
namespace {

CameraText visp_json_camera(const nlohmann::json& file, const std::string& where) {
  const auto number = [&](const char* key) {
    const auto it = file.find(key);
    if (it == file.end() || !it->is_number())
      throw InputError(where, std::string("has no number '") + key + "'", "restore the file");
    return it->get<double>();
  };
  const auto model = file.find("model");
  if (model == file.end() || !model->is_string())
    throw InputError(where, "has no 'model'", "restore the file");
  const std::string name = model->get<std::string>();
  StatedLens lens{LensKind::kPinhole, {number("px"), number("py"), number("u0"), number("v0")}, {}};
  if (name == "perspectiveWithDistortion" || name == "perspectiveProjWithDistortion") {
    lens.kind = LensKind::kPlumbBob;
    lens.coefficients = {number("kud"), 0, 0, 0};
  } else if (name != "perspectiveWithoutDistortion" && name != "perspectiveProjWithoutDistortion") {
    throw InputError(where, "ViSP's " + quote(name) + " is not supported",
                     "save the camera as perspectiveWithDistortion");
  }
  return camera_of_lens(std::move(lens), 0, 0, where);
}

}  // namespace

bool is_visp_json(const std::string& text) {
  if (!is_basalt(text)) return false;  // no JSON at all
  const auto file = parse_shallow_json(text);
  return file.is_object() && file.contains("u0");
}

NamedCameras visp_json_cameras(const std::string& text, const std::string& where) {
  return {{"camera", [file = parse_shallow_json(text), where] { return visp_json_camera(file, where); }}};
}

}  // namespace edgevo
