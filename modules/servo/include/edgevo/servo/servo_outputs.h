#pragma once
// What `edgevo servo` leaves in its output folder:
//   servo.csv                        one row for each image and command: true and believed error, age,
//   latency, command, true pose start.png, taught.png, final.png the three views with the fed points: where
//   they are (crosses) and where they are wanted (circles) convergence.svg                  true and believed
//   error over time report.html                      all of it on one page summary.yaml the figures
#include <string>
#include <vector>

#include "edgevo/report/latency_figures.h"
#include "edgevo/servo/closed_loop.h"

namespace edgevo {

struct ServoRunInfo {
  ServoParams params;
  std::string params_yaml;  ///< of the odometry
  std::vector<std::string> command_line;
};

/// Throws InputError when something cannot be written; the folder is there.
void write_servo_outputs(const std::string& folder, const ServoResult& result, const ServoRunInfo& info);

std::string servo_csv(const ServoResult& result);
std::string servo_summary(const ServoResult& result, const ServoRunInfo& info);

/// Of the images that went through the odometry while the loop steered, milliseconds; zeros where none did.
LatencyFigures latency_figures(const ServoResult& result);

}  // namespace edgevo
