// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The camera from a recording of any scene, without a board. The odometry runs over the beginning of the
// recording with a guess, all its matches are adjusted together with the camera
// (self_calibration/lens_estimate.h), and both are repeated with the camera that was found until it stays:
// a better camera finds more and better matches. The focal length comes first and alone; principal point and
// distortion follow when it is nearly right, since from far off they would take over its part.
//
// The search starts at a wide view: from a focal length that is too short it comes up to the true one; from
// one too long it may run off to infinity. Hand-held motion that turns about all axes shows everything. A
// straight drive does not show the focal length at all: it trades against the depth of the scene.
#include <functional>
#include <memory>
#include <string>

#include "edgevo/core/camera.h"
#include "edgevo/core/image_source.h"

namespace edgevo {

/// How the camera is sought.
struct MotionCalibrationOptions {
  /// Focal length to start at, pixels; 0: half the longer side of the images (a view of 90 degrees).
  double focal_px = 0;
  /// Keyframes that a round takes, from 20 on; fewer where the recording ends or the map is lost before.
  int keyframes = 100;
  /// Seed of the odometry.
  uint64_t seed = 1;
  /// Called with one line after each round; may be empty.
  std::function<void(const std::string&)> log;
  /// Polled before each frame; true ends the search.
  std::function<bool()> stop;
};

/// A camera found from motion, and one standard deviation of what is in it.
struct MotionCalibration {
  /// Why no camera was found, as a phrase, and what to do; empty: it was found.
  std::string problem, remedy;
  /// The camera: plumb-bob, square pixels, k1 and k2 where they are significant; with a problem, the one to
  /// start at.
  Camera camera;
  /// Of the focal length and of the principal point, pixels.
  double sigma_f_px = 0, sigma_c_px = 0;
  /// Of k1 and k2; 0 for one that is not sought.
  double sigma_k1 = 0, sigma_k2 = 0;
  /// Keyframes of the last round, and number of rounds.
  int keyframes = 0, rounds = 0;
};

/// Opens the recording from its beginning; called once a round. Of its camera only the size is used.
using SourceOpener = std::function<std::unique_ptr<ImageSource>()>;

/// Finds the camera. There is a problem if the recording is too short or makes no map, or if its motion does
/// not determine the focal length to 3 %. Throws InputError, naming `where`, if the search was stopped.
/// Deterministic. Cost: up to thirty runs over the frames of so many keyframes.
MotionCalibration camera_from_motion(const SourceOpener& open, const std::string& where,
                                     const MotionCalibrationOptions& options = {});

}  // namespace edgevo
