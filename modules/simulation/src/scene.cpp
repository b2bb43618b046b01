// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/scene.h"

#include <algorithm>
#include <filesystem>

#include "drawn_params.h"
#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/core/records.h"
#include "edgevo/files/program_folder.h"
#include "light_change.h"
#include "motion.h"
#include "scene_params.h"
#include "season.h"
#include "worlds.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

const char* const kSteady = "steady";
constexpr double kNever = 1e18;  // seconds

// Folders of scenes: the source tree if the program runs from it, else the installation, of this program or
// of one that links the library.
std::vector<fs::path> scene_folders() {
  return {
#ifdef EDGEVO_SCENE_SOURCE_DIR
      EDGEVO_SCENE_SOURCE_DIR,
#endif
      data_folder() / "datasets/scenes", EDGEVO_SCENE_INSTALL_DIR};
}

// "lakeshore:winter" is the scene lakeshore in winter, "circuit:steady" is circuit in one light. A file may
// have a colon in its name.
void split_variant(const std::string& name, std::string* scene, std::string* variant) {
  std::error_code ignored;
  const size_t colon = name.rfind(':');
  *scene = name, variant->clear();
  if (colon == std::string::npos || fs::exists(name, ignored)) return;
  *scene = name.substr(0, colon), *variant = name.substr(colon + 1);
  const std::vector<std::string> known{"spring", "summer", "autumn", "winter", kSteady};
  if (std::find(known.begin(), known.end(), *variant) == known.end())
    throw InputError("scene " + name, "'" + *variant + "' is not a season, nor '" + kSteady + "'",
                     "did you mean '" + nearest_name(*variant, known) + "'?");
}

// Takes over the variant of the scene `name`.
void set_variant(const std::string& name, const std::string& variant, SceneParams* params) {
  if (variant == kSteady) {
    if (params->second_light.begins_s == 0)
      throw InputError("scene " + name, "has one light anyway", "remove ':" + variant + "'");
    params->second_light.begins_s = kNever;
  } else if (!variant.empty()) {
    params->world.season = variant;
  }
  if (!params->world.season.empty() && params->world.kind != "lakeshore")
    throw InputError("scene " + name, "has no seasons", "only worlds of the kind lakeshore have");
  apply_season(&params->world);
}

fs::path find_scene(const std::string& name_or_path) {
  std::error_code ignored;
  if (fs::is_regular_file(name_or_path, ignored)) return name_or_path;
  for (const fs::path& folder : scene_folders())
    if (fs::is_regular_file(folder / (name_or_path + ".yaml"), ignored))
      return folder / (name_or_path + ".yaml");
  std::string known;
  for (const std::string& name : scene_names()) known += (known.empty() ? "" : ", ") + name;
  throw InputError("scene " + name_or_path, "is neither a file nor a known scene",
                   known.empty() ? "give the path of a YAML file: the folder of edgevo's scenes was not found"
                                 : "give the path of a YAML file or one of " + known);
}

void set_motion(CameraMotion motion, const SceneParams& params, Scene* scene) {
  scene->T_scene_cam.clear(), scene->times.clear();
  for (int i = 0; i < params.frames; ++i) {
    scene->T_scene_cam.push_back(motion.T_scene_cam[size_t(i) * kStepsPerFrame]);
    scene->times.push_back(Timestamp::from_seconds(i / params.rate_hz));
  }
  scene->T_scene_cam_at = [motion = std::move(motion)](double seconds) { return motion.at(seconds); };
}

// The way of a hand is drawn: one that a seed leads through a wall is drawn again.
void draw_hand_again(const SceneParams& params, Scene* scene) {
  constexpr uint64_t kDraws = 20;  // one in five may be wrong
  for (uint64_t draw = 1; draw < kDraws && wall_crossed(*scene); ++draw)
    set_motion(make_trajectory(params, scene->seed, params.where.waypoints, draw), params, scene);
}

}  // namespace

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  std::error_code failed;
  for (const fs::path& folder : scene_folders())
    for (fs::directory_iterator it(folder, failed), end; !failed && it != end; it.increment(failed))
      if (it->path().extension() == ".yaml") names.push_back(it->path().stem().string());
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

Scene load_scene(const std::string& name_or_path, std::optional<uint64_t> seed) {
  std::string base, variant;
  split_variant(name_or_path, &base, &variant);
  const fs::path path = find_scene(base);
  const std::string where = path.string();
  SceneParams params = parse_scene(read_text(where, "give the path of a scene file"), where);
  set_variant(name_or_path, variant, &params);
  Scene scene;
  scene.name = path.stem().string() + (variant.empty() ? "" : ":" + variant);
  scene.seed = seed.value_or(uint64_t(params.seed));
  if (is_drawn(params.world.kind)) draw_params(scene.seed, where, &params);
  scene.camera = params.camera.camera;
  scene.noise_sigma = params.camera.noise_sigma;
  scene.shutter = {params.camera.rolling_shutter_s, params.camera.exposure_s};
  set_motion(make_trajectory(params, scene.seed, params.where.waypoints), params, &scene);
  scene.world = std::make_shared<const World>(build_world(params, scene.seed));
  if (params.motion.kind == "hand") draw_hand_again(params, &scene);
  if (params.second_light.begins_s > 0)
    scene.light_change = std::make_shared<const LightChange>(make_light_change(params, *scene.world));
  check_trajectory(scene, params.where.waypoints);
  return scene;
}

void mount_camera(const CameraMount& mount, Scene* scene) {
  const SE3 T_own_mounted = T_zup_world().inverse() * T_vehicle_cam(mount);
  for (SE3& T_scene_cam : scene->T_scene_cam) T_scene_cam = T_scene_cam * T_own_mounted;
  scene->T_scene_cam_at = [own = scene->T_scene_cam_at, T_own_mounted](double seconds) {
    return own(seconds) * T_own_mounted;
  };
  scene->mount = mount;
  check_trajectory(*scene, "--mount");
}

}  // namespace edgevo
