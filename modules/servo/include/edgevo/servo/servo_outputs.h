#pragma once
// What a run of the servo loop leaves in its folder:
//   servo.csv         one row for each image and command: errors, age, latency, command, true pose
//   start.png, taught.png, final.png   the three views with the fed points: where they are (crosses)
//                     and where they are wanted (circles)
//   convergence.svg   true and believed error over time
//   report.html       all of it on one page
//   summary.yaml      the figures
#include <string>
#include <vector>

#include "edgevo/results/run_folder.h"
#include "edgevo/servo/loop_params.h"
#include "edgevo/servo/loop_result.h"

namespace edgevo {

/// What is told of a run besides its result.
struct ServoRunInfo {
  ServoParams params;  ///< of the loop
  std::string params_yaml;  ///< of the odometry
  std::vector<std::string> command_line;  ///< program and arguments
};

/// When something could not be written, the rest is still tried, and then the first failure is thrown
/// (InputError).
void write_servo_outputs(const ServoResult& result, const ServoRunInfo& info, RunFolder* folder);

std::string servo_csv(const ServoResult& result);  ///< Text of servo.csv.
std::string servo_summary(const ServoResult& result, const ServoRunInfo& info);  ///< Text of summary.yaml.

}  // namespace edgevo
