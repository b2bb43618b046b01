// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "edgevo/core/output_file.h"
#include "edgevo/run_quality/run_warnings.h"
#include "summary_parts.h"

namespace edgevo {
namespace {

std::string calibration_statement(const CameraPosterior& c) {
  using State = CameraPosterior::State;
  switch (c.state_of(CameraNumber::kK1)) {
    case State::kOff:
      return "off: the camera file was taken as it is";
    case State::kTooEarly:
      return "the run was too short for an estimate";
    case State::kNotObservable:
      if (c.is_at_limit(CameraNumber::kK1))
        return "the estimate ran to its limit: the camera file may be wrong, in the focal length most of "
               "all, "
               "or the motion was too straight, too slow or too short";
      return "the motion was too straight, too slow or too short for an estimate";
    case State::kInsignificant:
      return "no significant residual distortion: the camera file was left alone";
    case State::kAtLimit:
      return "AT ITS LIMIT, not applied: the camera file is probably wrong, in the focal length most of all";
    case State::kApplied:
      return "applied: images and map are corrected by residual_k1";
  }
  return "";
}

std::string shutter_statement(const CameraPosterior& c) {
  using State = CameraPosterior::State;
  switch (c.state_of(CameraNumber::kReadout)) {
    case State::kOff:
      return c.applied.readout_s != 0 ? "off: readout_s was taken as given"
                                      : "off: all rows were taken as exposed at the same time";
    case State::kTooEarly:
      return "the run was too short for an estimate";
    case State::kNotObservable:
      return "the motion was too slow or too short for an estimate";
    case State::kInsignificant:
      return "no significant read-out time: a global shutter, a fast one, or turns too fast to show it";
    case State::kAtLimit:
      return "AT ITS LIMIT, not applied: the camera file is probably wrong";
    case State::kApplied:
      return "rolling: the rows of the images are corrected to the time of the middle row";
  }
  return "";
}

std::string focal_length_statement(const CameraPosterior& c) {
  const CameraPosterior::Corners& corners = c.corners;
  if (!c.is_sought[size_t(CameraNumber::kFocal)])
    return "off: the focal length was taken from the camera file";
  if (c.applied.focal != 0) return "applied: images and map are corrected by residual_focal";
  if (corners.sigma == 0) return "the camera did not turn enough, or showed too few corners, for an estimate";
  if (std::abs(corners.focal) < kImprobable * corners.sigma)
    return "not applied: the camera file's is right to three standard deviations of the estimate";
  if (corners.windows == corners.windows_weighed)
    return "not applied: corners contradict the camera file, and the matches of the map do not "
           "support them";
  return "NOT APPLIED, although corners contradict the camera file: they did so too late, or the estimate is "
         "at "
         "its limit";
}

void write_focal_length(const CameraPosterior& c, YamlWriter* y) {
  y->text("focal", to_string(c.state_of(CameraNumber::kFocal)));
  y->text("focal_result", focal_length_statement(c));
  y->number("residual_focal", c.applied.focal, 5);
  if (c.corners.sigma == 0) return;
  y->number("focal_estimate", c.corners.focal, 5);
  y->number("focal_standard_deviation", c.corners.sigma, 4);
  y->integer("focal_windows", c.corners.windows);
}

std::string lens_statement(const CameraPosterior& c) {
  if (c.applied.focal != 0) return "its focal length was applied";
  if (c.contradicts_focal_length())
    return "not applied: file, corners and matches together contradict the focal length of the camera file";
  return "not applied: by corners and matches, the focal length agrees with the camera file's to three "
         "standard deviations, " +
         fixed(100 * kImprobable * c.focal_sigma(), 1) + " %; a smaller error may not show";
}

void write_lens(const CameraPosterior& c, YamlWriter* y) {
  if (c.whole.keyframes == 0) return;
  y->text("lens_result", lens_statement(c));
  y->number("lens_k1", c.whole.mean_of(CameraNumber::kK1), 5);
  y->number("lens_k1_standard_deviation", c.whole.sigma_of(CameraNumber::kK1), 4);
  y->number("lens_k2", c.whole.mean_of(CameraNumber::kK2), 5);
  y->number("lens_k2_standard_deviation", c.whole.sigma_of(CameraNumber::kK2), 4);
  y->number("lens_focal", c.whole.mean_of(CameraNumber::kFocal), 5);
  y->number("lens_focal_standard_deviation", c.focal_sigma(), 4);
  y->integer("lens_keyframes", c.whole.keyframes);
}

}  // namespace

// x_file = (1 + residual_focal) x (1 + residual_k1 r^2): before the file's own distortion. Row v is taken
// readout_s (v / (height - 1) - 1/2) after the middle.
void write_self_calibration(const CameraPosterior& c, YamlWriter* y) {
  const double k1_sigma = c.given.sigma_of(CameraNumber::kK1),
               readout_sigma = c.given.sigma_of(CameraNumber::kReadout);
  y->open("self_calibration");
  y->text("state", to_string(c.state_of(CameraNumber::kK1)));
  y->text("result", calibration_statement(c));
  y->number("residual_k1", c.applied.k1, 5);
  if (k1_sigma > 0) {
    y->number("estimate", c.given.mean_of(CameraNumber::kK1), 5);
    y->number("standard_deviation", k1_sigma, 4);
    y->integer("keyframes", c.given.keyframes);
  }
  write_focal_length(c, y);
  write_lens(c, y);
  y->text("shutter", to_string(c.state_of(CameraNumber::kReadout)));
  y->text("shutter_result", shutter_statement(c));
  y->number("readout_s", c.applied.readout_s, 5);
  if (readout_sigma > 0) {
    y->number("readout_estimate", c.given.mean_of(CameraNumber::kReadout), 5);
    y->number("readout_standard_deviation", readout_sigma, 4);
    y->integer("readout_keyframes", c.given.keyframes);
  }
  y->close();
}

// Plumb-bob coefficients without a name of the lens, as the files of earlier versions have them.
void write_camera(const Camera& camera, YamlWriter* y) {
  const Pinhole p = camera.pinhole();
  y->open("camera");
  if (!camera.plumb_bob()) y->text("lens", to_string(camera.model));
  y->integer("width", p.width);
  y->integer("height", p.height);
  for (const auto& [key, value] : {std::pair("fx", p.fx), {"fy", p.fy}, {"cx", p.cx}, {"cy", p.cy}})
    y->number(key, value, 9);
  const CameraModel plumb_bob = PlumbBobModel{{}, camera.plumb_bob().value_or(Distortion())};
  for (const auto& [key, value] : coefficients_of(camera.plumb_bob() ? plumb_bob : camera.model))
    y->number(key, value, 9);
  y->close();
}

}  // namespace edgevo
