// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_quality/run_warnings.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "edgevo/core/output_file.h"

namespace edgevo {

namespace {

struct SeenFocalLength {
  double error = 0, sigma = 0;
};

// Corners also where there was no map to be adjusted.
std::optional<SeenFocalLength> contradicting_focal_length(const Run& run) {
  const auto newest = std::find_if(run.frames.rbegin(), run.frames.rend(), [](const FrameRecord& frame) {
    return std::isfinite(frame.evidence.focal_error);
  });
  if (newest != run.frames.rend()) {
    const FrameEvidence& e = newest->evidence;
    if (std::abs(e.focal_error) > kImprobable * e.focal_error_sigma)
      return SeenFocalLength{e.focal_error, e.focal_error_sigma};
  }
  const CameraPosterior& camera = run.camera;
  if (camera.applied.focal != 0 || !camera.contradicts_focal_length()) return std::nullopt;
  return SeenFocalLength{camera.whole.mean_of(CameraNumber::kFocal), camera.focal_sigma()};
}

// Images that are corrupt as a whole.
std::vector<std::string> image_faults_in_words(const Run& run) {
  const auto number = [&](ImageFault fault) {
    return std::count_if(run.frames.begin(), run.frames.end(),
                         [&](const FrameRecord& f) { return f.evidence.fault == fault; });
  };
  const std::string of_all = " of " + std::to_string(run.frames.size()) + " images are ";
  std::vector<std::string> lines;
  const auto add = [&](ImageFault fault, const char* what) {
    if (const auto n = number(fault)) lines.push_back(std::to_string(n) + of_all + what);
  };
  add(ImageFault::kTorn,
      "torn: a part of them is of an earlier image, and was not used. The driver hands out buffers that are "
      "still being written.");
  add(ImageFault::kInterlaced,
      "interlaced: every second row is of another time, and was not used. De-interlace the video (ffmpeg -vf "
      "yadif), or record progressive frames.");
  add(ImageFault::kMosaic,
      "raw mosaics of colours (Bayer), and were smoothed to gray. Converted to gray or colour before, they "
      "are sharper.");
  add(ImageFault::kRepeated, "those before, once more; their frames have the poses of those.");
  add(ImageFault::kBlank, "blank between others; their frames have no pose of their own.");
  return lines;
}

}  // namespace

std::vector<std::string> run_warnings(const Run& run) {
  std::vector<std::string> warnings = image_faults_in_words(run);
  const CameraPosterior& c = run.camera;
  using State = CameraPosterior::State;
  const State k1 = c.state_of(CameraNumber::kK1);
  const std::string k1_mean = fixed(c.given.mean_of(CameraNumber::kK1), 4);
  if (k1 == State::kAtLimit)
    warnings.push_back(
        "The lens distortion that self-calibration found (" + k1_mean +
        ") is at its limit and was not applied: the camera file is probably wrong, in its focal length most "
        "of all, or by distortion for images that are rectified already. Path and map are then wrong by far "
        "more than any figure here shows.");
  // Its prior keeps an estimate that nothing supports near 0, however straight the motion.
  if (k1 == State::kNotObservable && c.is_at_limit(CameraNumber::kK1))
    warnings.push_back("The lens distortion that self-calibration looked for ran to its limit (" + k1_mean +
                       " +- " + fixed(c.given.sigma_of(CameraNumber::kK1), 4) +
                       ") and was not applied: the camera file is probably wrong, in its focal length, its "
                       "image size or its distortion (is the image rectified already?), or the path is.");
  if (const std::optional<SeenFocalLength> seen = contradicting_focal_length(run))
    warnings.push_back("By the motion, the focal length is " + fixed(100 * seen->error, 1) + " +- " +
                       fixed(100 * seen->sigma, 1) +
                       " % off the camera file's: calibrate the camera (edgevo calibrate --chessboard, or "
                       "--from-motion).");
  if (c.applied.focal != 0)
    warnings.push_back(
        "The focal length is " + fixed(100 * c.applied.focal, 1) + " +- " + fixed(100 * c.focal_sigma(), 1) +
        " % off the camera file's, by the motion, and was corrected during the run. Run again with a "
        "camera file of edgevo calibrate RUN, or of a board (edgevo calibrate --chessboard).");
  if (c.state_of(CameraNumber::kReadout) == State::kAtLimit)
    warnings.push_back("The read-out time that self-calibration found (" +
                       fixed(c.given.mean_of(CameraNumber::kReadout), 3) +
                       " s) is at its limit and was not applied: the camera file or the times of the images "
                       "are probably wrong.");
  if (run.is_metric() && run.scale_varies())
    warnings.push_back(
        "The scale that " + run.scale_source + " gave varied from " + fixed(run.scale.lowest, 2) + " to " +
        fixed(run.scale.highest, 2) +
        " along the run: the odometry's own scale was not steady, so that lengths in between are "
        "uncertain. Causes: a wrong focal length, or a map lost during the run.");
  return warnings;
}

}  // namespace edgevo
