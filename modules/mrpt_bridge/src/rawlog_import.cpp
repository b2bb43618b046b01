// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/rawlog_import.h"

#include <mrpt/obs/CObservationImage.h>

#include <filesystem>
#include <set>

#include "edgevo/core/output_file.h"
#include "edgevo/files/image_names.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/image_file.h"
#include "edgevo/mrpt_bridge/rawlog_writer.h"
#include "edgevo/mrpt_bridge/sensor_observations.h"

namespace edgevo {
namespace {

constexpr const char* kDefaultLabel = "CAM0";  // of a source whose camera has no name
constexpr const char* kGyroLabel = "GYRO";

// The image's own name; with the frame's number if a second folder of the source has an image of the same
// name.
std::string unused_name(const Frame& frame, std::set<std::string>* used) {
  std::string name = image_name(frame);
  while (!used->insert(name).second) name += "_" + padded_number(frame.index);
  return name + ".png";
}

mrpt::obs::CObservationImage make_observation(const ImageSource& source, const std::string& label) {
  mrpt::obs::CObservationImage observation;
  observation.sensorLabel = label;
  observation.cameraParams = to_mrpt(source.camera());
  observation.cameraParams.cameraName = label;
  observation.cameraPose = to_mrpt(source.T_vehicle_cam().value_or(T_vehicle_cam_forward()));
  return observation;
}

// The other sensors of a source, or its gyro alone: a file next to the images, for example.
SensorReadings readings_of(const ImageSource& source) {
  if (SensorReadings sensors = source.sensor_readings()) return sensors;
  GyroReadings gyro = source.gyro_readings();
  if (!gyro) return {};
  return [gyro = std::move(gyro)]() -> std::optional<SensorReading> {
    const std::optional<GyroSample> sample = gyro();
    if (!sample) return std::nullopt;
    ImuReading imu;
    imu.angular_velocity = sample->rate, imu.acceleration = sample->acceleration;
    return SensorReading{sample->time, kGyroLabel, SE3(), imu};
  };
}

// Writes the readings of the other sensors between the images.
class SensorWriter {
 public:
  SensorWriter(SensorReadings readings, RawlogWriter* out) : readings_(std::move(readings)), out_(out) {
    advance();
  }

  // Those before an image; of the time before the first one only the last second.
  void write_before(Timestamp image) {
    if (!begins_) begins_ = Timestamp{image.ticks - kMargin};
    write_until(image.ticks);
    last_image_ = image;
  }
  // Those of the second after the last image.
  void finish() {
    if (begins_) write_until(last_image_.ticks + kMargin);
  }

 private:
  static constexpr int64_t kMargin = Timestamp::kTicksPerSecond;

  void write_until(int64_t ticks) {
    for (; next_ && next_->time.ticks <= ticks; advance())
      if (*begins_ <= next_->time) out_->write(*make_sensor_observation(*next_));
  }
  void advance() { next_ = readings_ ? readings_() : std::nullopt; }

  SensorReadings readings_;
  RawlogWriter* out_;
  std::optional<SensorReading> next_;
  std::optional<Timestamp> begins_;
  Timestamp last_image_;
};

}  // namespace

int import_rawlog(ImageSource& source, const std::string& rawlog_path, const ImportProgress& progress) {
  const std::filesystem::path folder = rawlog_stem(rawlog_path) + "_Images";
  make_output_folder(folder.string());
  const std::string label = source.label().empty() ? kDefaultLabel : source.label();
  mrpt::obs::CObservationImage observation = make_observation(source, label);
  RawlogWriter writer(rawlog_path);
  SensorWriter sensors(readings_of(source), &writer);
  std::set<std::string> used;
  int written = 0;
  while (const auto frame = source.next()) {
    sensors.write_before(frame->time);
    const std::string name = unused_name(*frame, &used);
    write_png((folder / name).string(), frame->image);
    observation.timestamp = to_mrpt(frame->time);
    observation.image.setExternalStorage(name);
    writer.write(observation);
    ++written;
    if (progress) progress(written);
  }
  sensors.finish();
  writer.close();
  return written;
}

}  // namespace edgevo
