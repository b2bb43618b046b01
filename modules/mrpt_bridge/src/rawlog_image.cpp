// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/rawlog_image.h"

#include <mrpt/obs/CObservation3DRangeScan.h>
#include <mrpt/obs/CObservationImage.h>
#include <mrpt/obs/CObservationStereoImages.h>

#include "edgevo/core/time_order.h"
#include "edgevo/mrpt_bridge/conversions.h"

namespace edgevo {
namespace {

std::optional<SE3> mount(const mrpt::poses::CPose3D& T_vehicle_cam) {
  const SE3 T = from_mrpt(T_vehicle_cam);
  const bool is_identity = T.angle() < 1e-9 && T.translation().norm() < 1e-9;
  if (is_identity || !T.is_finite()) return std::nullopt;
  return T;
}

void fill_from(const mrpt::obs::CObservationImage& o, RawlogImage* r) {
  *r = {"image", {}, {}, &o.image, &o.cameraParams, mount(o.cameraPose)};
}

void fill_from(const mrpt::obs::CObservationStereoImages& o, RawlogImage* r) {
  *r = {"left image of a stereo pair",
        {},
        {},
        &o.imageLeft,
        &o.leftCamera,
        mount(mrpt::poses::CPose3D(o.cameraPose))};
}

void fill_from(const mrpt::obs::CObservation3DRangeScan& o, RawlogImage* r) {
  *r = {"intensity image of a depth camera",
        {},
        {},
        &o.intensityImage,
        &o.cameraParamsIntensity,
        mount(o.sensorPose + o.relativePoseIntensityWRTDepth)};
}

}  // namespace

std::optional<RawlogImage> find_image(const mrpt::obs::CObservation& observation) {
  RawlogImage result;
  if (const auto* image = dynamic_cast<const mrpt::obs::CObservationImage*>(&observation))
    fill_from(*image, &result);
  else if (const auto* stereo = dynamic_cast<const mrpt::obs::CObservationStereoImages*>(&observation))
    fill_from(*stereo, &result);
  else if (const auto* scan = dynamic_cast<const mrpt::obs::CObservation3DRangeScan*>(&observation);
           scan && scan->hasIntensityImage)
    fill_from(*scan, &result);
  else
    return std::nullopt;
  result.label = observation.sensorLabel;
  const bool has_time = observation.timestamp != mrpt::Clock::time_point();
  result.time = has_time ? from_mrpt(observation.timestamp) : kNoTime;
  return result;
}

}  // namespace edgevo
