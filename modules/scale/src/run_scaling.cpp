// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/run_scaling.h"

#include <optional>

#include "edgevo/core/clock_shifts.h"
#include "edgevo/core/error.h"
#include "edgevo/core/time_order.h"
#include "edgevo/map/run_builder.h"
#include "edgevo/scale/given_scale.h"
#include "edgevo/scale/run_scale.h"
#include "edgevo/scale/track_scale.h"

namespace edgevo {
namespace {

const char* sensor_data_name(VehicleSensor sensor) {
  switch (sensor) {
    case VehicleSensor::kOdometry:
      return "odometry (CObservationOdometry)";
    case VehicleSensor::kGps:
      return "GPS fixes (CObservationGPS with GGA)";
    case VehicleSensor::kRobotPose:
      return "robot poses (CObservationRobotPose)";
  }
  return "";
}

// Number of positions recorded during the images; all of them if the times of the images are not known in
// advance.
size_t positions_during_images(const VehicleTrack& track, const std::vector<Timestamp>& times) {
  std::optional<Timestamp> first, last;  // the clock may have been set back, and some may be missing
  const std::vector<int64_t> shifts = clock_shifts(times);
  for (size_t i = 0; i < times.size(); ++i) {
    if (times[i] == kNoTime) continue;
    const Timestamp t{times[i].ticks + shifts[i]};
    if (!first || t < *first) first = t;
    if (!last || *last < t) last = t;
  }
  size_t count = 0;
  for (const VehiclePosition& p : track.positions) count += !first || (*first <= p.time && p.time <= *last);
  return count;
}

VehicleTrack track_for(const ScaleSources& requested, VehicleSensor sensor, const ImageSource& source) {
  VehicleTrack track = source.vehicle_track(sensor);
  const std::string where = "--scale " + requested.text, what = sensor_data_name(sensor);
  if (track.positions.empty())
    throw InputError(where, "this source (" + source.kind() + ") recorded no " + what,
                     "give a rawlog that holds it, or another --scale");
  // One of several is named at the end.
  if (requested.list.size() == 1 && positions_during_images(track, source.times()) < kMinTrackPairs)
    throw InputError(where,
                     "fewer than " + std::to_string(kMinTrackPairs) + " of the source's " + what +
                         " were taken while its images were",
                     "compare the times, see edgevo info");
  return track;
}

VehicleTracks tracks_for(const ScaleSources& requested, const ImageSource& source) {
  VehicleTracks tracks;
  for (const ScaleSource& one : requested.list)
    if (const auto sensor = one.sensor()) tracks[*sensor] = track_for(requested, *sensor, source);
  return tracks;
}

// Of the segment in use.
const EpochPlace& newest_epoch(const EpochsPlaced& placed) {
  const EpochPlace* newest = &placed.epochs.front();
  for (const EpochPlace& e : placed.epochs)
    if (e.segment == placed.segment) newest = &e;
  return *newest;
}

}  // namespace

RunScaling::RunScaling(const ScaleSources& requested, const ImageSource& source, const Pinhole& pinhole,
                       const ScaleParams& params)
    : RunScaling(requested, tracks_for(requested, source), pinhole, source.T_vehicle_cam(), params) {}

RunScaling::RunScaling(const ScaleSources& requested, VehicleTracks tracks, const Pinhole& pinhole,
                       const std::optional<SE3>& T_vehicle_cam, const ScaleParams& params)
    : requested_(requested),
      params_(params),
      tracks_(std::move(tracks)),
      live_(pinhole, requested, tracks_, T_vehicle_cam, params) {}

void RunScaling::apply(const MapEvent& event) {
  if (!requested_.is_estimated()) return;
  if (const auto* placed = std::get_if<SegmentPlaced>(&event)) {
    T_odom_map_[placed->segment] = placed->T_world_map;
    waiting_.clear();
  } else if (const auto* epochs = std::get_if<EpochsPlaced>(&event)) {
    add_waiting();
    follow(*epochs);
  } else if (const auto* frame = std::get_if<FrameAnchored>(&event)) {
    add_waiting();
    live_.add_frame(frame->frame);
  } else if (const auto* marginalised = std::get_if<KeyframeMarginalised>(&event)) {
    waiting_.push_back(*marginalised);
  } else if (const auto* moved = std::get_if<MapMoved>(&event)) {
    add_waiting();
    live_.apply(*moved);
  }
}

// The live path goes on in the unit of the newest epoch.
void RunScaling::follow(const EpochsPlaced& epochs) {
  const auto T_odom_map = T_odom_map_.find(epochs.segment);
  if (T_odom_map == T_odom_map_.end() || epochs.epochs.empty()) return;
  live_.rescale(epochs.segment, newest_epoch(epochs).first_keyframe,
                epochs.T_odom_map.scale / T_odom_map->second.scale);
  T_odom_map->second = epochs.T_odom_map;
}

void RunScaling::add_waiting() {
  for (const KeyframeMarginalised& marginalised : waiting_) {
    KeyframeRecord keyframe = *marginalised.keyframe;
    const auto T_odom_map = T_odom_map_.find(keyframe.segment);
    if (T_odom_map == T_odom_map_.end()) continue;  // in a damaged recovery log only
    move_to_world(T_odom_map->second, &keyframe);
    live_.add_keyframe(marginalised.id, keyframe);
  }
  waiting_.clear();
}

std::optional<ScaleEstimate> RunScaling::newest() const {
  const ScaleSource& first = requested_.list.front();
  if (first.kind == ScaleSource::Kind::kFactor) return ScaleEstimate{first.value, 0, 0};
  return live_.newest();
}

void RunScaling::convert(Run* run) const {
  if (const ScaleSource& only = requested_.list.front(); only.kind == ScaleSource::Kind::kFactor)
    scale_run(only.value, only.text, run);
  if (!requested_.is_estimated()) return;
  const RunScale scale = estimate_run_scale(*run, requested_, tracks_, params_);
  if (scale.of_frame.empty())
    run->scale.problem = "--scale " + requested_.text + ": " + scale.problem;
  else
    make_metric(scale, live_.history(), requested_, run);
}

}  // namespace edgevo
