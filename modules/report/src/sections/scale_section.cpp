// SPDX-License-Identifier: BSD-3-Clause
#include "scale_section.h"

#include <limits>

#include "edgevo/core/output_file.h"
#include "edgevo/report/chart.h"
#include "edgevo/report/page.h"
#include "edgevo/report/palette.h"
#include "edgevo/run_quality/scale_faults.h"
#include "edgevo/scale/scale_source.h"

namespace edgevo {
namespace {

std::string percent(double share) { return fixed(100 * share, 2) + " %"; }

std::string how_it_was_found(const ScaleSource& source) {
  switch (source.kind) {
    case ScaleSource::Kind::kNone:
      return "No source of scale was given; a single camera cannot measure it.";
    case ScaleSource::Kind::kFactor:
      return "The factor was given; its uncertainty is unknown.";
    case ScaleSource::Kind::kCameraHeight:
      return "The camera is " + fixed(source.value, 3) +
             " m above the ground; its height in units was measured from edges on the ground along its "
             "path.";
    case ScaleSource::Kind::kOdometry:
      return "The path was compared with the odometry of the vehicle.";
    case ScaleSource::Kind::kGps:
      return "The path was compared with GPS.";
    case ScaleSource::Kind::kRobotPose:
      return "The path was compared with the recorded poses of the robot.";
    case ScaleSource::Kind::kKeptMap:
      return "The run was found in a map in metres, given with --map.";
  }
  return "";
}

std::string how_it_was_found(const ScaleSources& sources) {
  std::string text;
  for (const ScaleSource& source : sources.list) text += (text.empty() ? "" : " ") + how_it_was_found(source);
  if (sources.list.size() > 1)
    text += " Each counts by its uncertainty, and not where it contradicts the rest.";
  return text;
}

std::string estimate_text(const Run& run) {
  const ScaleRecord& s = run.scale;
  std::string text = " One unit of the odometry is " + fixed(s.factor, 4) + " m";
  if (s.sigma > 0) text += " ± " + percent(s.sigma) + " (one standard deviation)";
  text += ", median over the frames";
  if (s.lowest < s.highest)
    text += "; from " + fixed(s.lowest, 4) + " to " + fixed(s.highest, 4) +
            " m along the path; this drift has been corrected";
  text += ".";
  if (s.frames_carried_over > 0)
    text += " It was not measured on " + std::to_string(s.frames_carried_over) + " of " +
            std::to_string(s.frames.size()) + " frames, which take what the scale around them says.";
  return text;
}

TimeChart scale_chart(const Run& run) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  TimeChart chart;
  chart.y_name = "metres per unit";
  Series upper{"plus 1 sigma", palette::kPaleBlue, {}}, lower{"minus 1 sigma", palette::kPaleBlue, {}},
      live{"live", palette::kAmber, {}}, all{"measured", palette::kBlue, {}};
  for (size_t i = 0; i < run.frames.size(); ++i) {
    const FrameScale& f = run.scale.frames[i];
    chart.x.push_back(seconds_between(run.frames.front().time, run.frames[i].time));
    upper.y.push_back(f.factor * (1 + f.sigma)), lower.y.push_back(f.factor * (1 - f.sigma));
    live.y.push_back(f.live_factor > 0 ? f.live_factor : kNone);
    all.y.push_back(f.factor);
  }
  chart.series = {upper, lower, live, all};
  return chart;
}

std::string shutter_text(const CameraPosterior& camera) {
  const double sigma = camera.given.sigma_of(CameraNumber::kReadout);
  std::string html =
      " Rolling shutter: <b>" + html_escaped(to_string(camera.state_of(CameraNumber::kReadout))) + "</b>";
  if (sigma > 0)
    html += ", read-out " + fixed(camera.given.mean_of(CameraNumber::kReadout), 4) + " ± " + fixed(sigma, 4) +
            " s from " + std::to_string(camera.given.keyframes) + " keyframes";
  if (camera.applied.readout_s != 0) html += ", " + fixed(camera.applied.readout_s, 4) + " s applied";
  return html + ".";
}

std::string focal_length_text(const CameraPosterior& camera) {
  const CameraPosterior::Corners& corners = camera.corners;
  const double applied = camera.applied.focal;
  const std::string outcome = applied != 0 ? fixed(100 * applied, 1) + " % applied." : "not applied.";
  if (corners.sigma == 0) return applied != 0 ? " Focal length by matches: " + outcome : std::string();
  return " Focal length by corners: <b>" + fixed(100 * corners.focal, 1) + " ± " +
         fixed(100 * corners.sigma, 1) + " %</b> off the file's, " + outcome;
}

std::string whole_lens_text(const CameraPosterior& camera) {
  const CameraGaussian& lens = camera.whole;
  if (lens.keyframes == 0) return {};
  const auto number = [&](CameraNumber n) {
    return fixed(lens.mean_of(n), 4) + " ± " + fixed(lens.sigma_of(n), 4);
  };
  return " By file, corners and matches together, with k2 and focal length free: k1 " +
         number(CameraNumber::kK1) + ", k2 " + number(CameraNumber::kK2) + ", focal length " +
         fixed(100 * lens.mean_of(CameraNumber::kFocal), 1) + " ± " + fixed(100 * camera.focal_sigma(), 1) +
         " % off the file's.";
}

std::string lens_text(const CameraPosterior& camera) {
  const double sigma = camera.given.sigma_of(CameraNumber::kK1);
  std::string html = "<p>Self-calibration of the lens: <b>" +
                     html_escaped(to_string(camera.state_of(CameraNumber::kK1))) + "</b>";
  if (sigma > 0)
    html += ", residual k1 " + fixed(camera.given.mean_of(CameraNumber::kK1), 5) + " ± " + fixed(sigma, 5) +
            " from " + std::to_string(camera.given.keyframes) + " keyframes";
  return html + "." + focal_length_text(camera) + whole_lens_text(camera) + shutter_text(camera) + "</p>\n";
}

}  // namespace

std::string scale_section(const Run& run) {
  std::string body = "<p>Unit: <b>" + html_escaped(unit_statement(run)) + "</b>. Source of scale: <b>" +
                     html_escaped(run.scale_source) + "</b>. " +
                     html_escaped(how_it_was_found(recorded_scale_sources(run.scale_source)) +
                                  (run.is_metric() ? estimate_text(run) : "")) +
                     "</p>\n";
  for (const std::string& line : scale_faults_in_words(run))
    body += "<p class=\"bad\">" + html_escaped(line) + "</p>\n";
  if (!run.scale.problem.empty()) body += "<p class=\"bad\">" + html_escaped(run.scale.problem) + "</p>\n";
  if (!run.scale.frames.empty() && run.scale.frames.size() == run.frames.size())
    body += draw(scale_chart(run));
  return section_html("scale", "Scale and camera", body + lens_text(run.camera));
}

}  // namespace edgevo
