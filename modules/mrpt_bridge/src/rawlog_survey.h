// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Contents of a rawlog, determined by reading it once without its images.
#include <mrpt/img/TCamera.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/mrpt_bridge/intensities.h"

namespace edgevo {

struct SurveyedCamera {
  std::string label, kind;
  std::vector<Timestamp> times;
  /// Calibration of the first image.
  mrpt::img::TCamera camera;
  /// Mount at the first image.
  std::optional<SE3> T_vehicle_cam;
  /// True if its images are files next to the rawlog.
  bool external = false;
  /// Values of some of its embedded images, all over what was read; empty if the first has 8 bits.
  IntensityCount intensities = {};
  /// Names of some of its external images, all over what was read.
  std::vector<std::string> some_files = {};
};

struct RawlogSurvey {
  /// The cameras, in the order of their first image.
  std::vector<SurveyedCamera> cameras;
  /// Number of observations without an image, by class name.
  std::map<std::string, int> others;
  /// False if the file is longer than the survey reads.
  bool complete = true;
  /// Message of the InputError that ended the reading early; else empty.
  std::string damage;

  const SurveyedCamera* find(const std::string& label) const;
  /// Text such as "CAM0 (300 images), CAM1 (300 images)".
  std::string list() const;
};

/// Reads at most the first 256 MB of the file. Throws InputError if it cannot be opened or its checksum is
/// wrong (then nothing in it can be trusted); a truncated file or one with an unknown class is surveyed up to
/// that point.
RawlogSurvey survey_rawlog(const std::string& path);

}  // namespace edgevo
