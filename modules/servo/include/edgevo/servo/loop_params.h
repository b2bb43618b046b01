#pragma once
// What a run of the servo loop in the simulator is given.
#include <cstdint>
#include <optional>
#include <string>

namespace edgevo {

/// Parameters of the loop.
struct ServoParams {
  std::string law = "pbvs";         ///< or "ibvs"
  double rate_hz = 20;              ///< of images and commands
  std::optional<double> latency_s;  ///< of the odometry for an image; none: measured
  bool cpu_latency = false;  ///< measured as CPU time, as on a machine that has nothing else to do; else by
                             ///< the clock on the wall
  double scale_error = 1;    ///< the feed's metres over true metres
  std::string light;  ///< kind of lighting change (simulation/relight.h) once the pose is taught; empty: none
  double blackout_s = 0;       ///< the images are black for so long
  double blackout_at_s = 1.5;  ///< after the servo loop has begun
  int points = 20;             ///< fed, and steered by in IBVS
  double gain = 1;             ///< lambda, 1/s
  double limit_s = 25;         ///< the servo loop ends after so long even if it has not converged
  uint64_t seed = 1;  ///< of start, noise and light
};

}  // namespace edgevo
