// SPDX-License-Identifier: BSD-3-Clause
#include "rawlog_imus.h"

#include <mrpt/obs/CObservationIMU.h>

#include <memory>

#include "edgevo/core/error.h"
#include "edgevo/core/image_clock.h"
#include "edgevo/mrpt_bridge/conversions.h"
#include "edgevo/mrpt_bridge/rawlog_image.h"
#include "edgevo/mrpt_bridge/rawlog_reader.h"

namespace edgevo {
namespace {

using namespace mrpt::obs;

// Rates in the axes of the sensor; nothing if it measured none.
std::optional<ImuReading> reading_of(const CObservationIMU& imu) {
  ImuReading reading;
  const TIMUDataIndex rates[] = {IMU_WX, IMU_WY, IMU_WZ}, accelerations[] = {IMU_X_ACC, IMU_Y_ACC, IMU_Z_ACC};
  for (int i = 0; i < 3; ++i) {
    if (!imu.has(rates[i])) return std::nullopt;
    reading.angular_velocity[i] = imu.get(rates[i]);
    if (imu.has(accelerations[i])) reading.acceleration[i] = imu.get(accelerations[i]);
  }
  if (!reading.angular_velocity.allFinite()) return std::nullopt;
  return reading;
}

class ImuReader {
 public:
  ImuReader(const std::string& path, const std::vector<Timestamp>& image_times)
      : reader_(path), clock_(image_times) {}

  std::optional<SensorReading> next() {
    try {
      while (const auto observation = reader_.next()) {
        const Timestamp stated = from_mrpt(observation->timestamp);
        clock_.pass(stated);
        const auto* imu = dynamic_cast<const CObservationIMU*>(observation.get());
        if (!imu) continue;
        if (const auto reading = reading_of(*imu))
          return SensorReading{clock_.correct(stated), imu->sensorLabel, SE3(), *reading};
      }
    } catch (const InputError&) {
      // The reader of the images meets the same damage and reports it.
    }
    return std::nullopt;
  }

 private:
  RawlogReader reader_;
  ImageClock clock_;
};

}  // namespace

SensorReadings read_rawlog_imus(const std::string& path, const std::vector<Timestamp>& image_times) {
  return [path, image_times, reader = std::shared_ptr<ImuReader>()]() mutable {
    if (!reader) reader = std::make_shared<ImuReader>(path, image_times);
    return reader->next();
  };
}

}  // namespace edgevo
