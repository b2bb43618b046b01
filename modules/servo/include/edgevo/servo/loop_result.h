// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Result of a run of the servo loop in the simulator.
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/records.h"
#include "edgevo/run_quality/run_statistics.h"
#include "edgevo/servo/control_laws.h"
#include "edgevo/servo/kept_goal.h"
#include "edgevo/servo/motion_plan.h"

namespace edgevo {

/// One image and one command.
struct ServoRow {
  /// Time since the first image.
  double time_s = 0;
  /// Phase of the loop: what moves the camera.
  Phase phase = Phase::kTeach;
  /// Tracking state reported by the feed.
  TrackingState state = TrackingState::kBootstrapping;
  /// Age of the pose that the command is based on.
  double age_s = 0;
  /// Latency of the odometry for this image; 0: the image was replaced.
  double latency_s = 0;
  /// Command; set in the servo phase only.
  Command command;
  /// True pose of the camera.
  SE3 T_scene_cam;
  /// True distance of the camera from the taught pose, millimetres and degrees.
  double true_mm = 0, true_deg = 0;
};

/// Result of the whole loop.
struct ServoResult {
  /// Reason why the loop never began; empty: it did.
  std::string failure;
  /// Whether the loop stayed at its goal: the median error of a second, by its own estimate, is within it.
  bool converged = false;
  /// One row for each image, in time order.
  std::vector<ServoRow> rows;
  /// Scale given to the feed.
  double metres_per_unit = 0;
  /// True errors at the end; px: rms over the points of the feed.
  double final_mm = 0, final_deg = 0, final_px = 0;
  /// True errors at the beginning of the servo loop; px: rms over the points of the feed.
  double start_mm = 0, start_deg = 0, start_px = 0;
  /// Number of times that the robot was stopped in the servo phase.
  int stops = 0;
  /// Total time that it was stopped.
  double stopped_s = 0;
  /// Number of waiting images that were replaced by newer ones.
  int replaced = 0;
  /// Camera of the rendered images.
  Camera camera;
  /// The goal with its map, if it was taught in this loop.
  std::optional<KeptLoop> kept;
  /// Images at the taught pose, at the start and at the end, with distortion.
  GrayImage taught, start, final;
  /// True pixels of the feed's points at the taught pose, undistorted.
  std::vector<Eigen::Vector2d> points_taught;
  /// True pixels of the feed's points at the start, undistorted.
  std::vector<Eigen::Vector2d> points_start;
  /// True pixels of the feed's points at the end, undistorted.
  std::vector<Eigen::Vector2d> points_final;
};

/// Latency of the images that the odometry processed in the servo phase, milliseconds; zeros if there are
/// none.
LatencyFigures latency_figures(const ServoResult& result);

}  // namespace edgevo
