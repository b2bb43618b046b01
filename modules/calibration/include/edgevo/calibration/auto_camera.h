// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The camera of `edgevo run --camera auto`.
#include <functional>
#include <string>

#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// What stands for a camera file where the camera is to be found from the motion.
constexpr const char* kAutoCamera = "auto";

/// A camera found from the motion of a recording, or assumed where the motion does not show it.
class AutoCamera {
 public:
  /// Seeks the camera of `*source`, whose camera file this replaces, from what EXIF says on or from a view of
  /// 90 degrees; `log` and `stop` as in MotionCalibrationOptions. Throws InputError for a live camera, which
  /// cannot be played again, and where `stop` ends it. Cost: camera_from_motion().
  AutoCamera(SourceOptions* source, uint64_t seed, const std::function<void(const std::string&)>& log,
             const std::function<bool()>& stop);
  /// Removes the file that the camera is in meanwhile.
  ~AutoCamera();
  /// It owns a file.
  AutoCamera(const AutoCamera&) = delete;
  /// It owns a file.
  AutoCamera& operator=(const AutoCamera&) = delete;

  /// What it is and what it rests on; a doubt if it is assumed.
  const InputDecision& decision() const { return decision_; }
  /// The camera as a file, for `--camera` of the next run; empty if it is assumed.
  const std::string& found() const { return found_; }

 private:
  InputDecision decision_;
  std::string found_, path_;
};

}  // namespace edgevo
