// SPDX-License-Identifier: BSD-3-Clause
// ViSP's cameras in JSON: px, py, u0, v0 and a model; with distortion also kud and kdu. The size is not in
// the file.
#include <nlohmann/json.hpp>

#include "camera_numbers.h"
#include "dialect.h"
#include "edgevo/core/error.h"
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
  const std::string name = model != file.end() && model->is_string() ? model->get<std::string>() : "";
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
  const size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] == '{' && text.find("\"u0\"") != std::string::npos;
}

NamedCameras visp_json_cameras(const std::string& text, const std::string& where) {
  const auto file = nlohmann::json::parse(text, nullptr, false);
  if (!file.is_object()) throw InputError(where, "is not complete JSON", "restore the file");
  return {{"camera", [file, where] { return visp_json_camera(file, where); }}};
}

}  // namespace edgevo
