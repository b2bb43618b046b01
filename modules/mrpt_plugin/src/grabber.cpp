// SPDX-License-Identifier: BSD-3-Clause
#include "grabber.h"

#include "camera_sensor_grabber.h"
#include "edgevo/core/bad_frame.h"
#include "edgevo/core/error.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {
namespace {

class RawlogGrabber : public Grabber {
 public:
  explicit RawlogGrabber(std::unique_ptr<ImageSource> source) : source_(std::move(source)) {}

  const Camera& camera() const override { return source_->camera(); }
  std::optional<SE3> T_vehicle_cam() const override { return source_->T_vehicle_cam(); }
  std::vector<InputDecision> decisions() const override { return source_->decisions(); }
  GyroReadings gyro_readings() const override { return source_->gyro_readings(); }
  std::optional<Grab> next() override {
    std::optional<Grab> grab(std::in_place);
    try {
      auto frame = source_->next();
      if (!frame) return std::nullopt;
      grab->frame = std::move(*frame);
    } catch (const BadFrame& e) {
      grab->frame.index = e.index();
      grab->frame.time = e.time();
      grab->problem = e.what();
    }
    grab->stated_time = grab->frame.time;
    return grab;
  }

 private:
  std::unique_ptr<ImageSource> source_;
};

}  // namespace

std::unique_ptr<Grabber> open_grabber(const mrpt::config::CConfigFileBase& config, const std::string& section,
                                      const std::string& calibration_file) {
  if (config.read_string_first_word(section, "grabber_type", "opencv") != "rawlog")
    return open_camera_sensor(config, section, calibration_file);
  SourceOptions options;
  options.path = config.read_string(section, "rawlog_file", "");
  options.sensor_label = config.read_string(section, "rawlog_camera_sensor_label", "");
  options.camera_file = calibration_file;
  if (options.path.empty())
    throw InputError("grabber_type rawlog", "the key rawlog_file is missing",
                     "write rawlog_file = FILE.rawlog");
  return std::make_unique<RawlogGrabber>(open_source(options));
}

}  // namespace edgevo
