#pragma once
// One image of one camera inside an observation, whichever of MRPT's three classes holds it.
#include <mrpt/img/CImage.h>
#include <mrpt/img/TCamera.h>
#include <mrpt/obs/CObservation.h>

#include <optional>
#include <string>

#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Points into the observation that it was made from.
struct RawlogImage {
  const char* kind = "";  ///< "image", "left image of a stereo pair", "intensity image of a depth camera"
  std::string label;  ///< of the sensor
  Timestamp time;  ///< of the observation
  bool has_time = false;  ///< false: the observation holds no time
  const mrpt::img::CImage* image = nullptr;  ///< not null
  const mrpt::img::TCamera* camera = nullptr;  ///< its calibration; not null
  /// Mount; nullopt where the observation holds the identity, which is what nobody has set (it would look
  /// straight up).
  std::optional<SE3> T_vehicle_cam;
};

/// nullopt if the observation holds no image of ours.
std::optional<RawlogImage> find_image(const mrpt::obs::CObservation& observation);

}  // namespace edgevo
