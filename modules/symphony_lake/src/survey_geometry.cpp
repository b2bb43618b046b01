// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/symphony_lake/survey_geometry.h"

#include <algorithm>
#include <cstdio>

namespace edgevo::symphony {
namespace {

// Of the focal length: two calibrations of one lens differ by a few hundredths, zooms by more.
constexpr double kSameZoom = 0.1;

// Relative difference of the focal lengths.
double difference(const Pinhole& a, const Pinhole& b) {
  return std::max(std::abs(std::log(a.fx / b.fx)), std::abs(std::log(a.fy / b.fy)));
}

}  // namespace

Lens lens_at(const Pinhole& pinhole) {
  const double calibrated = difference(pinhole, kCalibrated.pinhole()),
               rectified = difference(pinhole, kRectified);
  if (std::min(calibrated, rectified) > kSameZoom)
    return {{},
            "taken to be free of distortion: another zoom than that of the known calibration; --camera gives "
            "one"};
  if (rectified < calibrated)
    return {{}, "free of distortion: the focal lengths are those of rectified images"};
  return {kCalibrated.distortion(),
          "distortion as a user calibrated it at this zoom (the rows name none); --camera gives another"};
}

std::string older_name(int number) {
  char name[40];
  std::snprintf(name, sizeof name, "%04d/%04d.jpg", number / 1000, number % 1000);
  return name;
}

std::string newer_name(int number) {
  char name[40];
  std::snprintf(name, sizeof name, "%04d/%02d%03d.jpg", number / 1000, number / 1000, number % 1000);
  return name;
}

}  // namespace edgevo::symphony
