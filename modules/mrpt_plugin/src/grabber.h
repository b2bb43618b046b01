// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Images for the sensor, one after the other, from whatever CCameraSensor grabs.
#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/img/CImage.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/gyro_sample.h"
#include "edgevo/core/image_source.h"

namespace edgevo {

struct Grab {
  /// Its time increases; that of an unusable frame is the time of the one before.
  Frame frame;
  /// The image as delivered, colour included; empty if it equals frame.image.
  mrpt::img::CImage original;
  /// Time of the image in the clock of the recording, which may have been set back.
  Timestamp stated_time;
  /// Why the odometry cannot use the frame; empty if it can.
  std::string problem;
};

class Grabber {
 public:
  virtual ~Grabber() = default;
  virtual const Camera& camera() const = 0;
  virtual std::optional<SE3> T_vehicle_cam() const = 0;
  /// What the input was taken to be (ImageSource::decisions()).
  virtual std::vector<InputDecision> decisions() const { return {}; }
  /// ImageSource::gyro_readings().
  virtual GyroReadings gyro_readings() const { return {}; }
  /// The next image; nullopt at the end of a finite source. Throws InputError when no image arrives.
  virtual std::optional<Grab> next() = 0;
};

/// Opens what the section names, with CCameraSensor's keys. A rawlog is read by rawlog_source.h, which finds
/// its external images from any folder and takes calibration and mount from its observations; all others go
/// through mrpt::hwdrivers::CCameraSensor. `calibration_file` (datasets/camera_file.h) takes precedence over
/// the calibration of the images; may be empty. Throws InputError.
std::unique_ptr<Grabber> open_grabber(const mrpt::config::CConfigFileBase& config, const std::string& section,
                                      const std::string& calibration_file);

}  // namespace edgevo
