// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A scene: a world, a camera and its motion through it, read from a YAML file such as
// datasets/scenes/street.yaml.
//
// The file names the kind of world (street, desk, lakeshore, corridor, plaza, ...), a seed, the camera and
// the motion; the world is then grown from the seed, textures included. The same file and seed give the same
// scene, to the byte.
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/camera_mount.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/simulation/body.h"
#include "edgevo/simulation/light.h"
#include "edgevo/simulation/world.h"

namespace edgevo {

/// When the rows of an image are exposed. Time, pose and depth of a frame are those of the middle of the
/// exposure of the middle row, whatever the shutter.
struct Shutter {
  /// Delay of the last row's exposure after the first's, seconds (0.01 to 0.03 in common cameras).
  double rolling_s = 0;
  /// Exposure time of each row, seconds.
  double exposure_s = 0;

  /// Middle of the exposure of row v of `height`, in seconds relative to the time of the frame.
  double row_time(int v, int height) const {
    return rolling_s > 0 && height > 1 ? rolling_s * (double(v) / (height - 1) - 0.5) : 0;
  }
};

/// A world with a camera that moves through it.
struct Scene {
  /// File name without its suffix.
  std::string name;
  /// Seed of world, textures and noise.
  uint64_t seed = 0;
  /// Camera with its lens.
  Camera camera;
  /// Whether `camera` was given instead of that of the scene file.
  bool has_given_camera = false;
  /// Pose of the camera at each frame; scene axes as in world.h, metres.
  std::vector<SE3> T_scene_cam;
  /// Time of each frame, from 0 s.
  std::vector<Timestamp> times;
  /// Pose at any time in seconds, for exposures of finite duration.
  std::function<SE3(double)> T_scene_cam_at;
  /// Mount of the camera, if it is not that of the scene (mount_camera()).
  std::optional<CameraMount> mount;
  /// Shutter, by default global and instantaneous.
  Shutter shutter;
  /// Standard deviation of the sensor noise, gray levels.
  double noise_sigma = 0;
  /// Change of the world's light; null: none.
  std::shared_ptr<const LightChange> light_change;
  /// World; shared, since it may take tens of megabytes.
  std::shared_ptr<const World> world;
  /// What moves through the world by itself (add_traffic()).
  std::vector<Body> bodies;
  /// The kinds of traffic that were added.
  std::vector<std::string> traffic;

  /// Number of frames.
  int size() const { return int(T_scene_cam.size()); }
};

/// Loads a scene: the name of one that ships with the program ("street"), or the path of a YAML file. `seed`
/// overrides that of the file. Throws InputError: no such scene (the known ones are named), unknown key,
/// unknown kind of texture, value out of range, no frames, a trajectory through a wall. Cost: about a second,
/// for textures and shadows.
Scene load_scene(const std::string& name_or_path, std::optional<uint64_t> seed = std::nullopt);

/// Turns the camera of `scene` on the vehicle that its own camera would be, level and looking straight ahead
/// at the vehicle's origin. Throws InputError if the camera then passes through a wall.
void mount_camera(const CameraMount& mount, Scene* scene);

/// Names that load_scene accepts without a path, sorted.
std::vector<std::string> scene_names();

/// The first frame after which the camera passes through a solid surface, before the next; nullopt: none.
std::optional<int> wall_crossed(const Scene& scene);

/// Throws InputError naming `where` if the camera passes through a solid surface between two frames.
void check_trajectory(const Scene& scene, const std::string& where);

}  // namespace edgevo
