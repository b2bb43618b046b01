// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// ViSP's control laws around a ServoFeed: position-based (PBVS) and image-based (IBVS), eye in hand.
#include <visp3/vs/vpServo.h>

#include <memory>
#include <string>

#include "edgevo/visp_bridge/servo_points.h"

namespace edgevo {

/// Command of a control law, and the distance to its goal as estimated from the feed.
struct Command {
  /// Velocity [v, w] of the camera in its own axes, metres and radians per second; zero if `stop` is set.
  vpColVector velocity = vpColVector(6);
  /// Reason why the robot must stop; empty: it may move.
  std::string stop;
  /// PBVS: remaining translation, metres, and rotation, degrees.
  double translation_m = 0, rotation_deg = 0;
  /// IBVS: rms distance of the points from their desired positions, pixels.
  double image_px = 0;
  /// Whether the distance is within the law's tolerance.
  bool at_goal = false;
};

/// One control law with its goal.
class ControlLaw {
 public:
  virtual ~ControlLaw() = default;
  /// Makes the current view the goal. Returns false, with the reason in `*why`, without a usable pose or with
  /// too few points.
  [[nodiscard]] virtual bool teach(const ServoPose& pose, std::string* why) = 0;
  /// Makes a pose of the camera the goal: world to camera, metres, in the map of that version. Only PBVS can.
  virtual void aim(const vpHomogeneousMatrix& cdMw, int map_version) = 0;
  /// The command for a pose. Stops if the pose is not usable or belongs to another map than the goal.
  virtual Command command(const ServoPose& pose) = 0;
  /// The points of the feed at `pose`; empty for a law without points.
  virtual std::vector<ServoPoint> points(const ServoPose& pose) = 0;
};

/// Makes a control law. `law` is "pbvs" or "ibvs"; both choose `points` points. `gain`: lambda, 1/s.
std::unique_ptr<ControlLaw> make_control_law(const std::string& law, const Pinhole& pinhole, double gain,
                                             int points);

}  // namespace edgevo
