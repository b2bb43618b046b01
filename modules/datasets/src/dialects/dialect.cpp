// SPDX-License-Identifier: BSD-3-Clause
#include "dialect.h"

#include <algorithm>

#include "edgevo/core/error.h"
#include "text_file.h"

namespace edgevo {
namespace {

std::string listed(const NamedCameras& cameras) {
  constexpr size_t kMax = 8;
  std::string text;
  for (size_t i = 0; i < std::min(kMax, cameras.size()); ++i) text += (i == 0 ? "" : ", ") + cameras[i].name;
  return text + (cameras.size() > kMax ? ", ..." : "");
}

}  // namespace

const Dialect* dialect_of(const std::string& text) {
  static const Dialect all[] = {{is_colmap_binary, colmap_binary_cameras},
                                {is_visp_json, visp_json_cameras},
                                {is_basalt, basalt_cameras},
                                {is_xml, xml_cameras},
                                {is_mrpt_ini, mrpt_ini_cameras},
                                {is_colmap_text, colmap_text_cameras},
                                {is_dso, dso_cameras}};
  const auto it = std::find_if(std::begin(all), std::end(all), [&](const auto& d) { return d.is_it(text); });
  return it == std::end(all) ? nullptr : it;
}

const YamlDialect* dialect_of(const YamlValues& values) {
  static const YamlDialect all[] = {{is_slam_settings, slam_settings_cameras},
                                    {is_camodocal, camodocal_cameras},
                                    {is_kalibr, kalibr_cameras}};
  const auto it =
      std::find_if(std::begin(all), std::end(all), [&](const auto& d) { return d.is_it(values); });
  return it == std::end(all) ? nullptr : it;
}

CameraText chosen_camera(const NamedCameras& cameras, const std::string& sensor, const std::string& where) {
  if (cameras.empty()) throw InputError(where, "holds no camera", "restore the file");
  if (cameras.size() == 1) return cameras.front().read();
  const auto has_name = [&](const NamedCamera& camera) { return camera.name == sensor; };
  const auto it = std::find_if(cameras.begin(), cameras.end(), has_name);
  if (it == cameras.end())
    throw InputError(where,
                     "holds several cameras" + (sensor.empty() ? "" : ", none of them " + quote(sensor)),
                     "choose one with --sensor: " + listed(cameras));
  CameraText text = it->read();
  text.note = it->name + (text.note.empty() ? "" : "; " + text.note);
  return text;
}

CameraText camera_of_lens(StatedLens lens, int width, int height, const std::string& where) {
  CameraText text;
  text.camera.model = model_of(std::move(lens), where);
  text.camera.width = width, text.camera.height = height;
  check_camera_text(text, where);
  return text;
}

bool begins_with(const std::string& text, const char* start) { return text.rfind(start, 0) == 0; }

}  // namespace edgevo
