#pragma once
// ViSP's control laws around a ServoFeed: position-based (PBVS) and image-based (IBVS), eye in hand.
#include <visp3/vs/vpServo.h>

#include <memory>
#include <string>

#include "edgevo/visp_bridge/servo_points.h"

namespace edgevo {

/// What a law wants, and how far it believes to be from its goal.
struct Command {
  /// Of the camera in its own axes, [v, w]; metres and radians a second; zero when `stop` says why.
  vpColVector velocity = vpColVector(6);
  std::string stop;                            ///< why the robot must stop; empty: it may move
  double translation_m = 0, rotation_deg = 0;  ///< PBVS: left to go
  double image_px = 0;   ///< IBVS: rms distance of the points from where they are wanted
  bool at_goal = false;  ///< within the law's tolerance
};

/// One control law with its goal.
class ControlLaw {
 public:
  virtual ~ControlLaw() = default;
  /// Makes the present view the goal. False (with `*why`) if it cannot be: no usable pose, too few points.
  [[nodiscard]] virtual bool teach(const ServoPose& pose, std::string* why) = 0;
  /// The command for the newest pose. Stops when that is not usable or belongs to another map than the goal.
  virtual Command command(const ServoPose& pose) = 0;
  /// The points that are fed, at `pose`; empty for a law without points.
  virtual std::vector<ServoPoint> points(const ServoPose& pose) = 0;
};

/// `law` is "pbvs" or "ibvs"; both show `points` points.
std::unique_ptr<ControlLaw> make_control_law(const std::string& law, const Pinhole& pinhole, double gain,
                                             int points);

}  // namespace edgevo
