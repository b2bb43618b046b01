// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/gyro_of_sensors.h"

#include <algorithm>
#include <deque>
#include <map>
#include <memory>
#include <utility>

namespace edgevo {
namespace {

// Measurements of inertial sensors from which one is chosen: a second of several fast ones.
constexpr int kSearched = 1000;

// Of other sensors before the first inertial one: a recording without one is not read to its end.
constexpr double kSearchedS = 10;

// The next inertial measurement.
std::optional<SensorReading> next_inertial(const SensorReadings& readings) {
  while (auto reading = readings())
    if (std::holds_alternative<ImuReading>(reading->value)) return reading;
  return std::nullopt;
}

std::optional<SensorReading> first_inertial(const SensorReadings& readings) {
  std::optional<Timestamp> begin;
  while (auto reading = readings()) {
    if (std::holds_alternative<ImuReading>(reading->value)) return reading;
    if (!begin) begin = reading->time;
    if (seconds_between(*begin, reading->time) > kSearchedS) break;
  }
  return std::nullopt;
}

const ImuReading& imu_of(const SensorReading& reading) { return std::get<ImuReading>(reading.value); }

struct ChosenGyro {
  SensorReadings readings;
  std::deque<SensorReading> first;
  std::string label;

  std::optional<GyroSample> next() {
    while (true) {
      std::optional<SensorReading> reading;
      if (!first.empty()) {
        reading = std::move(first.front());
        first.pop_front();
      } else {
        reading = next_inertial(readings);
      }
      if (!reading) return std::nullopt;
      if (reading->label == label)
        return GyroSample{reading->time, imu_of(*reading).angular_velocity, imu_of(*reading).acceleration};
    }
  }
};

}  // namespace

GyroReadings gyro_of(SensorReadings readings) {
  if (!readings) return {};
  const auto chosen = std::make_shared<ChosenGyro>();
  chosen->readings = std::move(readings);
  std::map<std::string, int> turning;  // by label
  for (int i = 0; i < kSearched; ++i) {
    auto reading = i == 0 ? first_inertial(chosen->readings) : next_inertial(chosen->readings);
    if (!reading) break;
    if (!imu_of(*reading).angular_velocity.isZero()) ++turning[reading->label];
    chosen->first.push_back(std::move(*reading));
  }
  const auto most = std::max_element(turning.begin(), turning.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  if (most == turning.end()) return {};
  chosen->label = most->first;
  return [chosen] { return chosen->next(); };
}

}  // namespace edgevo
