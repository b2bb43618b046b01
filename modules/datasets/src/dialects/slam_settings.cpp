// SPDX-License-Identifier: BSD-3-Clause
// Settings files of ORB-SLAM2/3 (`Camera.fx` or `Camera1.fx`, `Camera.type`, `Camera.k1` ...; of a stereo
// pair to rectify also LEFT.K and LEFT.D) and of stella_vslam (`Camera: fx`, model, cols, rows). Settings of
// other parts of these programs are ignored.
#include <algorithm>

#include "camera_keys.h"
#include "camera_numbers.h"
#include "dialect.h"
#include "edgevo/core/error.h"
#include "edgevo/core/suggestion.h"
#include "text_file.h"

namespace edgevo {
namespace {

using Keys = std::vector<std::string>;

const Keys& settings_keys() {
  static const Keys keys{
      "fx", "fy", "cx", "cy", "k1", "k2", "k3", "k4", "p1", "p2", "type", "width", "height",
      // Without influence on the camera of raw images: how the program plays and resizes them.
      "fps", "rgb", "bf", "newwidth", "newheight", "imagescale", "nlabels", "overlappingbegin",
      "overlappingend", "lappingbegin", "lappingend",
      // stella_vslam
      "name", "setup", "model", "cols", "rows", "color_order", "focal_x_baseline", "depth_threshold"};
  return keys;
}

std::string text_of(const YamlValues& values, const std::string& key) {
  const auto it = values.find(key);
  return it == values.end() || it->second.texts.empty() ? std::string() : it->second.texts.front();
}

// ---- Camera., Camera1., Camera2. ----

class Settings {
 public:
  Settings(const YamlValues& values, std::string group, std::string where)
      : values_(values), group_(std::move(group)), where_(std::move(where)) {}

  CameraText camera() const {
    check_keys();
    StatedLens lens = named_lens();
    lens.intrinsics = {needed("fx"), needed("fy"), needed("cx"), needed("cy")};
    return camera_of_lens(std::move(lens), side({"width", "cols"}), side({"height", "rows"}), where_);
  }

 private:
  void check_keys() const {
    Keys known;
    for (const std::string& name : settings_keys()) known.push_back(group_ + "." + name);
    for (const auto& [key, value] : values_) {
      if (key.rfind(group_ + ".", 0) != 0 || std::count(known.begin(), known.end(), key)) continue;
      const std::string suggestion = did_you_mean(key, known);
      throw InputError(where_ + ", line " + std::to_string(value.line), "unknown key " + quote(key),
                       suggestion.empty() ? "remove it if it does not belong to the camera" : suggestion);
    }
  }
  double number(const std::string& name, double missing) const {
    const auto all = yaml_numbers(values_, {group_ + "." + name}, where_);
    return all.empty() ? missing : all.front();
  }
  double needed(const std::string& name) const {
    if (!values_.count(group_ + "." + name))
      throw InputError(where_, quote(group_ + "." + name) + " is missing", "restore the settings file");
    return number(name, 0);
  }
  // 0 if the settings do not have it: those of ORB-SLAM2 need not.
  int side(const Keys& names) const {
    for (const std::string& name : names)
      for (const std::string& key : {group_ + "." + name, "camera." + name})
        if (const auto all = yaml_numbers(values_, {key}, where_); !all.empty())
          return image_side(all.front(), where_);
    return 0;
  }
  StatedLens named_lens() const {
    const std::string type = text_of(values_, "camera.type"), model = text_of(values_, group_ + ".model");
    StatedLens lens;
    if (type == "Rectified") return lens;
    if (type == "KannalaBrandt8" || model == "fisheye") {
      lens.kind = LensKind::kKannalaBrandt;
      lens.coefficients = {number("k1", 0), number("k2", 0), number("k3", 0), number("k4", 0)};
      return lens;
    }
    if ((!type.empty() && type != "PinHole") || (!model.empty() && model != "perspective"))
      throw InputError(where_,
                       "the camera is " + quote(type.empty() ? model : type) + ", which is not supported",
                       "settings are read with PinHole, Rectified, KannalaBrandt8, perspective and fisheye");
    lens.kind = LensKind::kPlumbBob;
    lens.coefficients = {number("k1", 0), number("k2", 0), number("p1", 0), number("p2", 0), number("k3", 0)};
    return lens;
  }

  const YamlValues& values_;
  std::string group_, where_;
};

// ---- LEFT., RIGHT. ----

CameraText raw_camera(const YamlValues& values, const std::string& group, const std::string& where) {
  const auto K = numbers_of(values, {group + ".k"}, where);
  if (K.size() != 9) fail_count(where, group + ".K", K.size(), "3x3 numbers, row by row");
  StatedLens lens{LensKind::kPlumbBob, {K[0], K[4], K[2], K[5]}, numbers_of(values, {group + ".d"}, where)};
  const auto side = [&](const char* name) {
    const auto all = yaml_numbers(values, {group + "." + name}, where);
    return all.empty() ? 0 : image_side(all.front(), where);
  };
  return camera_of_lens(std::move(lens), side("width"), side("height"), where);
}

}  // namespace

bool is_slam_settings(const YamlValues& values) {
  return values.count("camera.fx") || values.count("camera1.fx") || values.count("camera.setup");
}

NamedCameras slam_settings_cameras(const YamlValues& values, const std::string& where) {
  NamedCameras cameras;
  for (const auto& [group, name] :
       {std::pair("camera", "Camera"), std::pair("camera1", "Camera1"), std::pair("camera2", "Camera2")})
    if (values.count(std::string(group) + ".fx") ||
        (std::string(group) == "camera" && values.count("camera.setup")))
      cameras.push_back({name, [values, group = std::string(group), where] {
                           return Settings(values, group, where).camera();
                         }});
  for (const auto& [group, name] : {std::pair("left", "LEFT"), std::pair("right", "RIGHT")})
    if (values.count(std::string(group) + ".k.data"))
      cameras.push_back(
          {name, [values, group = std::string(group), where] { return raw_camera(values, group, where); }});
  return cameras;
}

}  // namespace edgevo
