// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The base of sources that change one thing about another source.
#include <memory>
#include <utility>

#include "edgevo/core/image_source.h"

namespace edgevo {

/// Passes everything on to the source that it owns: a derived class overrides what differs.
class WrappedSource : public ImageSource {
 public:
  /// `inner` is not null.
  explicit WrappedSource(std::unique_ptr<ImageSource> inner) : inner_(std::move(inner)) {}

  const Camera& camera() const override { return inner_->camera(); }
  std::optional<SE3> T_vehicle_cam() const override { return inner_->T_vehicle_cam(); }
  std::optional<int> size() const override { return inner_->size(); }
  std::string kind() const override { return inner_->kind(); }
  bool is_live() const override { return inner_->is_live(); }
  std::string label() const override { return inner_->label(); }
  VehicleTrack vehicle_track(VehicleSensor sensor) const override { return inner_->vehicle_track(sensor); }
  SensorReadings sensor_readings() const override { return inner_->sensor_readings(); }
  GyroReadings gyro_readings() const override { return inner_->gyro_readings(); }
  std::vector<std::pair<std::string, std::string>> details() const override { return inner_->details(); }
  std::vector<InputDecision> decisions() const override { return inner_->decisions(); }
  std::vector<Timestamp> times() const override { return inner_->times(); }
  std::string ground_truth_path() const override { return inner_->ground_truth_path(); }
  std::optional<Frame> next() override { return inner_->next(); }
  bool skip() override { return inner_->skip(); }

 protected:
  /// The source that is wrapped.
  const ImageSource& inner() const { return *inner_; }
  /// The same, to read from.
  ImageSource& inner() { return *inner_; }

 private:
  std::unique_ptr<ImageSource> inner_;
};

}  // namespace edgevo
