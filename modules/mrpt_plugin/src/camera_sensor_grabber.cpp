// SPDX-License-Identifier: BSD-3-Clause
#include "camera_sensor_grabber.h"

#include <mrpt/hwdrivers/CCameraSensor.h>

#include <chrono>
#include <thread>

#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"
#include "edgevo/core/time_order.h"
#include "edgevo/datasets/camera_file.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/rawlog_image.h"
#include "one_line.h"
#include "stop_signal.h"

namespace edgevo {
namespace {

using Grabbed = std::vector<mrpt::serialization::CSerializable::Ptr>;

// CCameraSensor returns nothing, immediately and for ever, at the end of a video, and for a moment when a
// stream stalls. This many attempts with a pause between them give it a second: no camera takes that long.
constexpr int kEmptyGrabs = 50;
constexpr std::chrono::milliseconds kPause{20};

mrpt::obs::CObservation::Ptr image_among(const Grabbed& grabbed) {
  for (const auto& object : grabbed) {
    const auto observation = std::dynamic_pointer_cast<mrpt::obs::CObservation>(object);
    if (observation && find_image(*observation)) return observation;
  }
  return nullptr;
}

class CameraSensorGrabber : public Grabber {
 public:
  CameraSensorGrabber(const mrpt::config::CConfigFileBase& config, const std::string& section,
                      const std::string& calibration_file)
      : where_("grabber_type " + config.read_string_first_word(section, "grabber_type", "opencv")) {
    if (!calibration_file.empty()) camera_ = read_camera_file(calibration_file);
    try {
      sensor_.loadConfig(config, section);
      sensor_.initialize();
    } catch (const std::exception& e) {
      throw InputError(where_, "the camera does not open (" + one_line(e) + ")",
                       "check its keys, the path and the cable");
    }
    waiting_ = grab_until_an_image_comes();
    if (!waiting_)
      throw InputError(where_, "the camera opens, but gives no image (" + why_ended_ + ")",
                       "check its keys, the path and the cable");
    take_calibration_from(*waiting_);
  }

  const Camera& camera() const override { return *camera_; }
  std::optional<SE3> T_vehicle_cam() const override { return mount_; }

  std::optional<Grab> next() override {
    const mrpt::obs::CObservation::Ptr observation =
        waiting_ ? std::exchange(waiting_, nullptr) : grab_until_an_image_comes();
    // CCameraSensor throws the same at the end of a video and for a camera that stops.
    if (!observation) throw InputError(where_, "no more images (" + why_ended_ + ")", "");
    return to_grab(*observation);
  }

 private:
  /// Null when there are no more images, or after Ctrl-C. With grab_decimation CCameraSensor returns null
  /// objects for the frames it skips.
  mrpt::obs::CObservation::Ptr grab_until_an_image_comes() {
    try {
      why_ended_ = "end of the video, or the stream has stopped";
      for (int empty = 0; empty < kEmptyGrabs && !stop_requested();) {
        Grabbed grabbed;
        sensor_.getNextFrame(grabbed);
        if (const auto image = image_among(grabbed)) return image;
        empty = grabbed.empty() ? empty + 1 : 0;
        if (grabbed.empty()) std::this_thread::sleep_for(kPause);
      }
    } catch (const std::exception& e) {
      why_ended_ = one_line(e);
    }
    return nullptr;
  }

  void take_calibration_from(const mrpt::obs::CObservation& observation) {
    const RawlogImage image = *find_image(observation);
    mount_ = image.T_vehicle_cam;
    if (camera_) return;
    const std::string where = where_ + ", its calibration";
    if (!(image.camera->fx() > 0))
      throw InputError(where, "the driver knows none",
                       "write calibration_file = FILE (numbers or ROS/OpenCV YAML)");
    camera_ = from_mrpt(*image.camera, where);
  }

  Grab to_grab(const mrpt::obs::CObservation& observation) {
    const RawlogImage image = *find_image(observation);
    const std::string where = where_ + ", image " + std::to_string(count_);
    Grab grab;
    grab.original = *image.image;
    const CheckedTime checked = times_.check(image.time);
    grab.stated_time = image.time;
    grab.problem = checked.problem;
    grab.frame = {count_, checked.time, from_mrpt(*image.image, scale_of(*image.image, where), where)};
    check_image_size(grab.frame.image, camera_->pinhole(), where);
    ++count_;
    return grab;
  }

  // A live camera cannot be looked at beforehand: its first image decides.
  const std::optional<IntensityScale>& scale_of(const mrpt::img::CImage& first, const std::string& where) {
    if (count_ > 0) return scale_;
    if (const auto deep = deep_from_mrpt(first, where)) scale_ = decide_intensities(*deep).scale;
    return scale_;
  }

  std::string where_, why_ended_;
  mrpt::hwdrivers::CCameraSensor sensor_;
  std::optional<Camera> camera_;
  std::optional<SE3> mount_;
  std::optional<IntensityScale> scale_;
  mrpt::obs::CObservation::Ptr waiting_;  // the first image, which opening has taken
  TimeOrder times_;
  int count_ = 0;
};

}  // namespace

std::unique_ptr<Grabber> open_camera_sensor(const mrpt::config::CConfigFileBase& config,
                                            const std::string& section, const std::string& calibration_file) {
  return std::make_unique<CameraSensorGrabber>(config, section, calibration_file);
}

}  // namespace edgevo
