#pragma once
// What is in a rawlog, found by reading it once without touching its images.
#include <mrpt/img/TCamera.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

struct SurveyedCamera {
  std::string label, kind;
  std::vector<Timestamp> times;
  mrpt::img::TCamera camera;         ///< of the first image
  std::optional<SE3> T_vehicle_cam;  ///< of the first image
  bool external = false;             ///< its images lie in files beside the rawlog
};

struct RawlogSurvey {
  std::vector<SurveyedCamera> cameras;  ///< in the order of their first image
  std::map<std::string, int> others;    ///< class name -> number of observations that hold no image
  bool complete = true;                 ///< false: the file was longer than the survey reads
  std::string damage;  ///< message of the InputError that ended the reading early; else empty

  const SurveyedCamera* find(const std::string& label) const;
  /// "CAM0 (300 images), CAM1 (300 images)"
  std::string list() const;
};

/// Reads at most the first 256 MB of the file. Throws InputError if it cannot be opened or its checksum is
/// wrong (then nothing in it can be trusted); a file that is cut short or holds an unknown class is surveyed
/// as far as it goes.
RawlogSurvey survey_rawlog(const std::string& path);

}  // namespace edgevo
