#pragma once
// A scene: a world, a camera and its motion through it, read from a YAML file such as datasets/scenes/street.yaml.
//
// The file names the kind of world (street, desk, lakeshore, corridor, plaza), a seed, the camera and the motion; the
// world is then grown from the seed, textures included. The same file and seed give the same scene, to the byte.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/simulation/world.h"

namespace edgevo {

struct Scene {
  std::string name;
  uint64_t seed = 0;
  Camera camera;
  std::vector<SE3> T_scene_cam;      ///< pose of the camera at each frame; scene axes as in world.h, metres
  std::vector<Timestamp> times;      ///< of each frame, from 0 s on
  double noise_sigma = 0;            ///< standard deviation of the sensor's noise, gray levels
  std::shared_ptr<const World> world;  ///< shared, since it may hold tens of megabytes

  int size() const { return int(T_scene_cam.size()); }
};

/// Reads a scene: the name of one that ships with the program ("street"), or the path of a YAML file. `seed` overrides the
/// file's own. Throws InputError: no such scene (the known ones are named), unknown key, unknown kind of texture, value out
/// of range, no frames, a trajectory through a wall. Cost: about a second, for the textures and the shadows.
Scene load_scene(const std::string& name_or_path, std::optional<uint64_t> seed = std::nullopt);

/// Names that load_scene knows without a path, sorted.
std::vector<std::string> scene_names();

/// Throws InputError naming `scene.name` when the camera passes through a solid surface between two frames.
void check_trajectory(const Scene& scene);

}  // namespace edgevo
