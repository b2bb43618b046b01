#include "edgevo/simulation/scene.h"

#include <algorithm>
#include <filesystem>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/core/program_folder.h"
#include "motion.h"
#include "scene_params.h"
#include "worlds.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

// Where scenes lie: the source tree while one works in it, else what was installed, with the program (PREFIX/bin) or
// for a program of another's.
std::vector<fs::path> scene_folders() {
  return {
#ifdef EDGEVO_SCENE_SOURCE_DIR
      EDGEVO_SCENE_SOURCE_DIR,
#endif
      program_folder().parent_path() / "share/edgevo/datasets/scenes", EDGEVO_SCENE_INSTALL_DIR};
}

fs::path find_scene(const std::string& name_or_path) {
  std::error_code ignored;
  if (fs::is_regular_file(name_or_path, ignored)) return name_or_path;
  for (const fs::path& folder : scene_folders())
    if (fs::is_regular_file(folder / (name_or_path + ".yaml"), ignored)) return folder / (name_or_path + ".yaml");
  std::string known;
  for (const std::string& name : scene_names()) known += (known.empty() ? "" : ", ") + name;
  throw InputError("scene " + name_or_path, "is neither a file nor a known scene",
                   "give the path of a YAML file or one of " + known);
}

void set_motion(CameraMotion motion, const SceneParams& params, Scene* scene) {
  for (int i = 0; i < params.frames; ++i) {
    scene->T_scene_cam.push_back(motion.T_scene_cam[size_t(i) * kStepsPerFrame]);
    scene->times.push_back(Timestamp::from_seconds(i / params.rate_hz));
  }
  scene->T_scene_cam_at = [motion = std::move(motion)](double seconds) { return motion.at(seconds); };
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
  const fs::path path = find_scene(name_or_path);
  const std::string where = path.string();
  const SceneParams params = parse_scene(read_file(where, "give the path of a scene file"), where);
  Scene scene;
  scene.name = path.stem().string();
  scene.seed = seed.value_or(uint64_t(params.seed));
  scene.camera = params.camera.camera;
  scene.noise_sigma = params.camera.noise_sigma;
  scene.shutter = {params.camera.rolling_shutter_s, params.camera.exposure_s};
  set_motion(make_trajectory(params, scene.seed, params.where.way_points), params, &scene);
  scene.world = std::make_shared<const World>(build_world(params, scene.seed));
  check_trajectory(scene, params.where.way_points);
  return scene;
}

}  // namespace edgevo
