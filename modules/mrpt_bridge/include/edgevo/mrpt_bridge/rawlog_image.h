// SPDX-License-Identifier: BSD-3-Clause
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

/// An image within an observation. Points into the observation it was made from.
struct RawlogImage {
  /// Kind: "image", "left image of a stereo pair" or "intensity image of a depth camera".
  const char* kind = "";
  /// Label of the sensor.
  std::string label;
  /// Time of the observation; kNoTime if it has none.
  Timestamp time;
  /// The image; not null.
  const mrpt::img::CImage* image = nullptr;
  /// Calibration of the image; not null.
  const mrpt::img::TCamera* camera = nullptr;
  /// Mount; nullopt if the observation has the identity, the default (a camera that looks straight up).
  std::optional<SE3> T_vehicle_cam;
};

/// The image of an observation; nullopt if it has no image of a supported class.
std::optional<RawlogImage> find_image(const mrpt::obs::CObservation& observation);

}  // namespace edgevo
