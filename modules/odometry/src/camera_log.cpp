// SPDX-License-Identifier: BSD-3-Clause
#include "camera_log.h"

#include <cstdio>

namespace edgevo {

std::vector<std::string> describe_changes(const ImageCorrection& before, const CameraPosterior& now) {
  std::vector<std::string> lines;
  char line[160];
  if (now.applied.k1 != before.k1) {
    std::snprintf(line, sizeof line,
                  "self-calibration: residual k1 = %.4f +- %.4f from %d keyframes, applied", now.applied.k1,
                  now.given.sigma_of(CameraNumber::kK1), now.given.keyframes);
    lines.push_back(line);
  }
  if (now.applied.focal != before.focal) {
    std::snprintf(line, sizeof line,
                  now.applied.focal == 0
                      ? "self-calibration: focal length %.1f +- %.1f %% off the file's, which is used again"
                      : "self-calibration: focal length %.1f +- %.1f %% off the file's, corrected",
                  100 * now.whole.mean_of(CameraNumber::kFocal), 100 * now.focal_sigma());
    lines.push_back(line);
  }
  if (now.applied.readout_s != before.readout_s) {
    std::snprintf(line, sizeof line,
                  "self-calibration: rolling shutter, read-out %.4f +- %.4f s from %d keyframes, applied",
                  now.applied.readout_s, now.given.sigma_of(CameraNumber::kReadout), now.given.keyframes);
    lines.push_back(line);
  }
  return lines;
}

std::string describe_border_mask(double share) {
  char line[120];
  std::snprintf(line, sizeof line,
                "border mask: %.0f %% of the images never receive light; no edges are taken there",
                100 * share);
  return line;
}

}  // namespace edgevo
