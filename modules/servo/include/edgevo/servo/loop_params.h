// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Parameters of the servo loop in the simulator.
#include <cstdint>
#include <optional>
#include <string>

namespace edgevo {

/// Parameters of the loop.
struct ServoParams {
  /// Control law: "pbvs" or "ibvs".
  std::string law = "pbvs";
  /// Rate of images and commands, hertz.
  double rate_hz = 20;
  /// Latency of the odometry, seconds; nullopt: measured.
  std::optional<double> latency_s;
  /// Whether the latency is measured as CPU time, as on an otherwise idle machine, or as wall-clock time.
  bool cpu_latency = false;
  /// Metres of the feed over true metres.
  double scale_error = 1;
  /// Kind of lighting change (simulation/relight.h) after teaching; empty: none.
  std::string light;
  /// Duration of a blackout, in which images are black, seconds.
  double blackout_s = 0;
  /// Begin of the blackout after the begin of the servo loop, seconds.
  double blackout_at_s = 1.5;
  /// Whether the camera is carried back to the start of the loop while it is dark.
  bool is_carried = false;
  /// Folder of an earlier loop, whose goal is to be reached by its map (servo/kept_goal.h); empty: the goal
  /// is taught in this one. Only "pbvs" can.
  std::string map;
  /// Number of points; IBVS steers by them.
  int points = 20;
  /// Gain lambda, 1/s.
  double gain = 1;
  /// Time limit of the servo loop, seconds.
  double limit_s = 25;
  /// Seed of start pose, noise and light.
  uint64_t seed = 1;
};

}  // namespace edgevo
