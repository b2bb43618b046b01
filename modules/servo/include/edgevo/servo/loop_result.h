#pragma once
// What a run of the servo loop in the simulator has led to.
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/records.h"
#include "edgevo/core/run_statistics.h"
#include "edgevo/servo/control_laws.h"
#include "edgevo/servo/motion_plan.h"

namespace edgevo {

/// One image and one command.
struct ServoRow {
  double time_s = 0;                                    ///< since the first image
  Phase phase = Phase::kTeach;                          ///< who moves the camera
  TrackingState state = TrackingState::kBootstrapping;  ///< as the feed tells it
  double age_s = 0;                                     ///< of the pose that the command rests on
  double latency_s = 0;              ///< of this image through the odometry; 0: it was replaced
  Command command;                   ///< of the servo phase
  SE3 T_scene_cam;                   ///< true
  double true_mm = 0, true_deg = 0;  ///< of the camera from the taught pose
};

/// The whole loop.
struct ServoResult {
  std::string failure;                               ///< why the loop never began; empty: it ran
  bool converged = false;                            ///< by the loop's own measure, for a second on end
  std::vector<ServoRow> rows;                        ///< in time order
  double metres_per_unit = 0;                        ///< that the feed was given
  double final_mm = 0, final_deg = 0, final_px = 0;  ///< true errors; px: rms over the fed points
  /// true errors as the servo loop begins; px: rms over the fed points
  double start_mm = 0, start_deg = 0, start_px = 0;
  int stops = 0;                   ///< times that the robot was stopped while steered
  double stopped_s = 0;            ///< how long, all together
  int replaced = 0;                ///< images that a newer one replaced
  Camera camera;                   ///< of the rendered images
  GrayImage taught, start, final;  ///< as the camera takes them, distortion included
  /// true pixels of the fed points at the taught pose, at the start and at the end, undistorted
  std::vector<Eigen::Vector2d> points_taught;  ///< true pixels of the fed points, undistorted
  std::vector<Eigen::Vector2d> points_start;   ///< the same at the start
  std::vector<Eigen::Vector2d> points_final;   ///< and at the end
};

/// Of the images that went through the odometry while the loop steered, milliseconds; zeros where none did.
LatencyFigures latency_figures(const ServoResult& result);

}  // namespace edgevo
