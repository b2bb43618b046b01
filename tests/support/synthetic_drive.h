// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Keyframes of a drive whose images differ from what the camera file says by a known distortion and read-out
// time, and self-calibration on them.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "edgevo/map/corrected_pixel.h"
#include "edgevo/self_calibration/self_calibration.h"
#include "support/bundle_adjustment_scene.h"

namespace edgevo::test {

struct SyntheticDrive {
  int keyframes = 60;
  /// Residual distortion of the images, unknown to the camera file.
  double k1 = 0;
  /// Read-out time of a rolling shutter, seconds.
  double readout_s = 0;
  double noise_px = 0.15;
  /// Metres per keyframe; 0: a standstill.
  double step = 1.0;
  uint64_t seed = 1;
};

// A path with gentle turns through points on both sides. Points are hosted by keyframes and matched, along
// random normals, in the keyframes around. Estimates are where a window would leave them: near the truth.
inline std::vector<Keyframe> make_drive(const SyntheticDrive& o) {
  const Pinhole camera = pinhole();
  Random random(o.seed);
  std::vector<SE3> T_world_cam(o.keyframes);
  for (int i = 1; i < o.keyframes; ++i) {
    Vector6d step = Vector6d::Zero();
    step << 0.02 * random.normal() * o.step, 0.02 * random.normal() * o.step, o.step,
        0.005 * random.normal() * o.step, 0.03 * std::sin(0.2 * i) * o.step, 0.005 * random.normal() * o.step;
    T_world_cam[i] = T_world_cam[i - 1] * SE3::exp(step);
  }
  std::vector<Keyframe> drive(o.keyframes);
  // The camera bobs and turns about its keyframes, five of them per second; everything it sees is as far away
  // as the middle of the points.
  for (Keyframe& k : drive) {
    k.motion.velocity << 0.3 * random.normal(), 0.5 * random.normal(), -5.0, 0.1 * random.normal(),
        0.1 * random.normal(), 0.1 * random.normal();
    k.motion.velocity *= o.step;
    k.motion.idepth.setConstant(0.08);
  }
  const auto seen_at = [&](int keyframe,
                           const Eigen::Vector2d& px) {  // true pixel -> pixel in the file's image
    return correct_pixel(camera, {o.k1, o.readout_s}, {}, drive[size_t(keyframe)].motion, px);
  };
  for (int h = 0; h < o.keyframes; ++h) {
    drive[h].id = 10 + h;
    drive[h].T_cam_world = T_world_cam[h].inverse();
    for (int n = 0; n < 120; ++n) {
      const Eigen::Vector2d px(random.uniform(20, 1220), random.uniform(10, 366));
      const double depth = random.uniform(5, 40);
      MapPoint p;
      p.px = seen_at(h, px);
      p.normal = Eigen::Vector2d::UnitX();
      p.idepth = 1.0 / depth;
      for (int t = std::max(0, h - 2); t < std::min(o.keyframes, h + 9); ++t) {
        const Eigen::Vector3d p_target =
            T_world_cam[t].inverse() * (T_world_cam[h] * Eigen::Vector3d(camera.ray(px) * depth));
        if (t == h || p_target.z() < 1 || !camera.contains(camera.project(p_target), 8)) continue;
        const double angle = random.uniform(0, 2 * M_PI);
        Observation seen;
        seen.keyframe_id = 10 + t;
        seen.match.kind = MatchKind::kEdge;
        seen.match.normal = {std::cos(angle), std::sin(angle)};
        seen.match.px = seen_at(t, camera.project(p_target)) +
                        o.noise_px * Eigen::Vector2d(random.normal(), random.normal());
        seen.match.inv_sigma_normal = 1.0 / 0.3;
        p.observations.push_back(seen);
      }
      if (!p.observations.empty()) drive[h].points.push_back(std::move(p));
    }
  }
  return drive;
}

constexpr size_t kDriveWindow = 12;

// The first `count` keyframes of a trajectory as a map whose last `active` ones are the window.
inline Map map_of(const std::vector<Keyframe>& drive, size_t count, size_t active = kDriveWindow) {
  Map map(pinhole(), std::make_shared<MapLog>());
  for (size_t i = 0; i < count; ++i) map.add(drive[i]);
  while (map.active().size() > active) map.marginalise_oldest({});
  return map;
}

// The move of a trajectory, as the map applies it.
struct CalibratedDrive {
  CameraPosterior state;
  std::optional<MapMoved> moved;
  std::vector<Keyframe> drive;
};

inline CalibratedDrive calibrate(const SyntheticDrive& o, const SelfCalibrationParams& params = {}) {
  CalibratedDrive out;
  out.drive = make_drive(o);
  SelfCalibration calibration(pinhole(), params);
  Map map = map_of(out.drive, out.drive.size());
  out.moved = calibration.estimate(map, BaOptions(), true);
  if (out.moved) out.moved = map.move(*out.moved, [](const Keyframe& k) { return k.pyramid; });
  out.state = calibration.state();
  return out;
}

}  // namespace edgevo::test
