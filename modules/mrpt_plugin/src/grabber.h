#pragma once
// Images for the sensor, one after the other, from whatever CCameraSensor grabs.
#include <mrpt/config/CConfigFileBase.h>
#include <mrpt/img/CImage.h>

#include <memory>
#include <optional>
#include <string>

#include "edgevo/core/image_source.h"

namespace edgevo {

struct Grab {
  Frame frame;
  mrpt::img::CImage original;  ///< as it came, colour included; empty: the same as frame.image
};

class Grabber {
 public:
  virtual ~Grabber() = default;
  virtual const Camera& camera() const = 0;
  virtual std::optional<SE3> T_vehicle_cam() const = 0;
  /// nullopt at the end of a source that has one. Throws InputError when an image does not come or cannot be
  /// used.
  virtual std::optional<Grab> next() = 0;
};

/// Opens what the section says, with CCameraSensor's keys. A rawlog is read by our own reader, which finds
/// its external images from any folder and takes calibration and mount from its observations; all others go
/// through mrpt::hwdrivers::CCameraSensor. `calibration_file` (datasets/camera_file.h) wins over the
/// calibration that comes with the images; may be empty. Throws InputError.
std::unique_ptr<Grabber> open_grabber(const mrpt::config::CConfigFileBase& config, const std::string& section,
                                      const std::string& calibration_file);

}  // namespace edgevo
