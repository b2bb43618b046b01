#include "edgevo/scale/run_scaling.h"

#include "edgevo/core/error.h"
#include "edgevo/scale/given_scale.h"
#include "edgevo/scale/run_scale.h"
#include "edgevo/scale/track_scale.h"

namespace edgevo {
namespace {

const char* what_it_reads(VehicleSensor sensor) {
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

// Positions taken while the images were; all of them where the times of the images are not known beforehand.
size_t positions_beside_images(const VehicleTrack& track, const std::vector<Timestamp>& times) {
  size_t count = 0;
  for (const VehiclePosition& p : track.positions)
    count += times.empty() || (times.front() <= p.time && p.time <= times.back());
  return count;
}

VehicleTrack track_for(const ScaleSource& asked, const ImageSource& source) {
  if (!asked.sensor()) return {};
  VehicleTrack track = source.vehicle_track(*asked.sensor());
  const std::string where = "--scale " + asked.text, what = what_it_reads(*asked.sensor());
  if (track.positions.empty())
    throw InputError(where, "this source (" + source.kind() + ") recorded no " + what,
                     "give a rawlog that holds it, or another --scale");
  if (positions_beside_images(track, source.times()) < kMinTrackPairs)
    throw InputError(where, "fewer than " + std::to_string(kMinTrackPairs) + " of the source's " + what + " were taken while its images were",
                     "compare the times, see edgevo info");
  return track;
}

}  // namespace

RunScaling::RunScaling(const ScaleSource& asked, const ImageSource& source, const ScaleParams& params)
    : RunScaling(asked, track_for(asked, source), source.camera().pinhole, source.T_vehicle_cam(), params) {}

RunScaling::RunScaling(const ScaleSource& asked, VehicleTrack track, const Pinhole& pinhole,
                       const std::optional<SE3>& T_vehicle_cam, const ScaleParams& params)
    : asked_(asked),
      params_(params),
      track_(std::move(track)),
      live_(pinhole, asked, track_, T_vehicle_cam, params) {}

void RunScaling::add_frame(const FrameRecord& frame, const Odometry& odometry) {
  if (!asked_.is_estimated()) return;
  const SettledKeyframes settled = odometry.settled_keyframes(settled_);
  settled_ += settled.keyframes.size();
  add_frame(frame, settled.keyframes);
}

void RunScaling::add_frame(const FrameRecord& frame, const std::vector<KeyframeRecord>& settled) {
  if (!asked_.is_estimated()) return;
  live_.add_frame(frame);
  for (const KeyframeRecord& keyframe : settled) live_.add_keyframe(keyframe);
}

void RunScaling::apply(Run* run) const {
  if (asked_.kind == ScaleSource::Kind::kFactor) scale_run(asked_.value, asked_.text, run);
  if (!asked_.is_estimated()) return;
  const RunScale scale = estimate_run_scale(*run, asked_, track_, params_);
  if (scale.of_frame.empty())
    run->scale.problem = "--scale " + asked_.text + ": " + scale.problem;
  else
    make_metric(scale, live_.history(), asked_, run);
}

}  // namespace edgevo
