// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Another source under changed light: its frames, from a folder, a rawlog or a renderer, pass through
// Relight.
#include <memory>

#include "edgevo/core/image_source.h"
#include "edgevo/simulation/relight.h"

namespace edgevo {

/// A source under changed light.
class RelitSource : public ImageSource {
 public:
  /// `source` is not null.
  RelitSource(std::unique_ptr<ImageSource> source, Relight relight)
      : source_(std::move(source)), relight_(std::move(relight)) {}

  const Camera& camera() const override { return source_->camera(); }
  std::optional<SE3> T_vehicle_cam() const override { return source_->T_vehicle_cam(); }
  VehicleTrack vehicle_track(VehicleSensor sensor) const override { return source_->vehicle_track(sensor); }
  /// Number of frames of the source; nullopt if frames may be dropped.
  std::optional<int> size() const override;
  std::string kind() const override { return source_->kind() + ", relit"; }
  std::string label() const override { return source_->label(); }
  std::vector<std::pair<std::string, std::string>> details() const override { return source_->details(); }
  std::vector<InputDecision> decisions() const override { return source_->decisions(); }
  /// Times of the source; empty if frames may be dropped.
  std::vector<Timestamp> times() const override;
  std::string ground_truth_path() const override { return source_->ground_truth_path(); }
  std::optional<Frame> next() override;

 private:
  std::unique_ptr<ImageSource> source_;
  Relight relight_;
  std::optional<Timestamp> begin_;
};

}  // namespace edgevo
