#pragma once
// A camera in a rendered scene, steered by ViSP's control laws with the odometry as its only sensor.
//
// Time is the simulation's, in steps of one image: the image is taken at the camera's true pose, goes through
// the odometry, and its result reaches the servo loop as much later as the odometry took (measured on this
// machine, or a given latency); while the odometry is busy a newer image waits and takes the place of an
// older one. The loop asks the feed at its own rate and its command holds until the next. With a given
// latency a run is bit-identical.
//
// Ground truth is used to judge, and once for the scale: what a length of the map is in metres is taken at
// the taught pose, times `scale_error`. A loop that is taught by its own feed does not need it to be right.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/odometry/odometry.h"
#include "edgevo/servo/control_laws.h"
#include "edgevo/servo/motion_plan.h"

namespace edgevo {

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
  uint64_t seed = 1;
};

/// One image and one command.
struct ServoRow {
  double time_s = 0;
  Phase phase = Phase::kTeach;
  TrackingState state = TrackingState::kBootstrapping;  ///< as the feed tells it
  double age_s = 0;                                     ///< of the pose that the command rests on
  double latency_s = 0;              ///< of this image through the odometry; 0: it was replaced
  Command command;                   ///< of the servo phase
  SE3 T_scene_cam;                   ///< true
  double true_mm = 0, true_deg = 0;  ///< of the camera from the taught pose
};

struct ServoResult {
  std::string failure;     ///< why the loop never began; empty: it ran
  bool converged = false;  ///< by the loop's own measure, for a second on end
  std::vector<ServoRow> rows;
  double metres_per_unit = 0;                        ///< that the feed was given
  double final_mm = 0, final_deg = 0, final_px = 0;  ///< true errors; px: rms over the fed points
  double start_mm = 0, start_deg = 0, start_px = 0;
  int stops = 0;  ///< times that the robot was stopped while steered
  double stopped_s = 0;
  int replaced = 0;  ///< images that a newer one replaced
  Camera camera;
  GrayImage taught, start, final;  ///< as the camera takes them, distortion included
  std::vector<Eigen::Vector2d> points_taught, points_start,
      points_final;  ///< true pixels of the fed points, undistorted
};

/// Runs it. `on_step(seconds)` is called after each image; false ends it early. Throws InputError for
/// parameters that cannot be.
ServoResult run_closed_loop(const ServoParams& params, const OdometryParams& odometry,
                            const std::function<bool(double)>& on_step);

}  // namespace edgevo
