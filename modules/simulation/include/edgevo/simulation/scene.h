#pragma once
// A scene: a world, a camera and its motion through it, read from a YAML file such as datasets/scenes/street.yaml.
//
// The file names the kind of world (street, desk, lakeshore, corridor, plaza), a seed, the camera and the motion; the
// world is then grown from the seed, textures included. The same file and seed give the same scene, to the byte.
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/simulation/world.h"

namespace edgevo {

/// When the rows of an image gather light. The time of a frame, its pose and its depth are those of the middle of the
/// exposure of the image's middle: what is true of the image as a whole, whatever the shutter.
struct Shutter {
  double rolling_s = 0;   ///< the last row is exposed this much later than the first (0.01 to 0.03 s in common cameras)
  double exposure_s = 0;  ///< each row gathers light for this long

  /// Middle of the exposure of row v of `height`, in seconds from the time of the frame.
  double row_time(int v, int height) const { return rolling_s > 0 && height > 1 ? rolling_s * (double(v) / (height - 1) - 0.5) : 0; }
};

struct Scene {
  std::string name;
  uint64_t seed = 0;
  Camera camera;
  std::vector<SE3> T_scene_cam;      ///< pose of the camera at each frame; scene axes as in world.h, metres
  std::vector<Timestamp> times;      ///< of each frame, from 0 s on
  std::function<SE3(double)> T_scene_cam_at;  ///< the same motion at any time, seconds; for a shutter that is open for a while
  Shutter shutter;
  double noise_sigma = 0;            ///< standard deviation of the sensor's noise, gray levels
  std::shared_ptr<const World> world;  ///< shared, since it may hold tens of megabytes

  int size() const { return int(T_scene_cam.size()); }
};

/// Reads a scene: the name of one that ships with the program ("street"), or the path of a YAML file; behind either a season, where the
/// world has these ("lakeshore:winter": spring, summer, autumn or winter, instead of the file's own). `seed` overrides the
/// file's own. Throws InputError: no such scene (the known ones are named), unknown key, unknown kind of texture, value out
/// of range, no frames, a trajectory through a wall. Cost: about a second, for the textures and the shadows.
Scene load_scene(const std::string& name_or_path, std::optional<uint64_t> seed = std::nullopt);

/// Names that load_scene knows without a path, sorted.
std::vector<std::string> scene_names();

/// Throws InputError naming `where` when the camera passes through a solid surface between two frames.
void check_trajectory(const Scene& scene, const std::string& where);

}  // namespace edgevo
