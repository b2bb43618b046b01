#pragma once
// A sequence of images from one camera, whatever it is stored in. Implementations live in mrpt_bridge (rawlogs) and
// datasets (folders, videos, live cameras).
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/vehicle_track.h"

namespace edgevo {

/// Frames of one camera, in time order, with what is known about them. One thread at a time.
class ImageSource {
 public:
  virtual ~ImageSource() = default;

  /// Calibration of the images that next() returns.
  virtual const Camera& camera() const = 0;
  /// Where the camera sits on the vehicle (x forward, y left, z up), if the source says so: p_vehicle = T p_cam.
  virtual std::optional<SE3> T_vehicle_cam() const { return std::nullopt; }
  /// Number of frames; nullopt where it cannot be known beforehand (live camera, some videos).
  virtual std::optional<int> size() const = 0;
  /// "KITTI odometry", "rawlog", ...; for `edgevo info` and summary.yaml.
  virtual std::string kind() const = 0;
  /// Images come at their own time and do not wait: a live camera.
  virtual bool is_live() const { return false; }
  /// The name of this camera in its source, such as the sensor label of a rawlog; empty where cameras have no names.
  virtual std::string label() const { return {}; }
  /// Where another sensor of the vehicle says that it was, if the source recorded such a one; empty where it did not. May read the
  /// source once more.
  virtual VehicleTrack vehicle_track(VehicleSensor) const { return {}; }
  /// What else `edgevo info` should tell, as name and value.
  virtual std::vector<std::pair<std::string, std::string>> details() const { return {}; }
  /// The times of all frames, where they are known without decoding the images; else empty.
  virtual std::vector<Timestamp> times() const { return {}; }
  /// Ground truth in the TUM format lying beside the images; empty if there is none.
  virtual std::string ground_truth_path() const { return {}; }

  /// The next frame, in time order; nullopt at the end. Throws BadFrame (bad_frame.h) for an image that does not decode
  /// or has not the camera's size: the next one may come; InputError for times that do not increase: then the source has ended.
  virtual std::optional<Frame> next() = 0;
  /// Passes over the next frame without decoding its image; false at the end.
  virtual bool skip() { return next().has_value(); }
};

}  // namespace edgevo
