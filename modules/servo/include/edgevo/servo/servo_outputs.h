// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Files of a run of the servo loop:
//   servo.csv         one row for each image and command: errors, age, latency, command, true pose
//   start.png, taught.png, final.png   three views with the points of the feed: true (crosses) and desired
//                     positions (circles)
//   convergence.svg   true and estimated error over time
//   report.html       the results on one page
//   summary.yaml      the figures
#include <string>
#include <vector>

#include "edgevo/results/run_folder.h"
#include "edgevo/servo/loop_params.h"
#include "edgevo/servo/loop_result.h"

namespace edgevo {

/// Description of a run besides its result.
struct ServoRunInfo {
  /// Parameters of the loop.
  ServoParams params;
  /// Parameters of the odometry, YAML.
  std::string params_yaml;
  /// Program and arguments.
  std::vector<std::string> command_line;
};

/// Writes all files. If one cannot be written, the rest still are, and the first failure is thrown at the end
/// (InputError).
void write_servo_outputs(const ServoResult& result, const ServoRunInfo& info, RunFolder* folder);

/// Text of servo.csv.
std::string servo_csv(const ServoResult& result);
/// Text of summary.yaml.
std::string servo_summary(const ServoResult& result, const ServoRunInfo& info);

}  // namespace edgevo
