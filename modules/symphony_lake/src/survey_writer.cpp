// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/symphony_lake/survey_writer.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "edgevo/core/error.h"
#include "edgevo/core/frame_checks.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/output_file.h"
#include "edgevo/symphony_lake/survey_geometry.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMark = "SOURCE.md";
constexpr int kDecimals = 6, kAngleDecimals = 9;  // metres and pixels; radians

bool is_survey_name(const std::string& name) {
  const auto digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  return (name.size() == 6 || (name.size() == 7 && std::islower(static_cast<unsigned char>(name[6])))) &&
         std::all_of(name.begin(), name.begin() + 6, digit);
}

bool same(const Distortion& a, const Distortion& b) {
  return a.k1 == b.k1 && a.k2 == b.k2 && a.p1 == b.p1 && a.p2 == b.p2 && a.k3 == b.k3;
}

// Azimuth (from x to the left) and elevation of the view, radians.
double azimuth(const SE3& T_world_cam) {
  const Eigen::Vector3d view = T_world_cam.R().col(2);
  return std::atan2(view.y(), view.x());
}
double elevation(const SE3& T_world_cam) { return std::asin(std::clamp(T_world_cam.R()(2, 2), -1.0, 1.0)); }

struct View {
  double pan = 0, tilt = 0;
};

// Pan and tilt common to all frames: medians of heading of travel minus view, and of the view's elevation.
View usual_view(const std::vector<SurveyFrame>& frames) {
  std::vector<double> pans, tilts;
  for (size_t i = 0; i < frames.size(); ++i) {
    tilts.push_back(elevation(frames[i].T_world_cam));
    if (i == 0) continue;
    const Eigen::Vector3d step =
        frames[i].T_world_cam.translation() - frames[i - 1].T_world_cam.translation();
    if (step.head<2>().norm() > 0)
      pans.push_back(
          std::remainder(std::atan2(step.y(), step.x()) - azimuth(frames[i].T_world_cam), 2 * M_PI));
  }
  return {median(std::move(pans)), median(std::move(tilts))};
}

// The boat below a camera.
struct BoatBelow {
  double x, y, theta;

  BoatBelow(const SE3& T_world_cam, const View& view) {
    theta = std::remainder(azimuth(T_world_cam) + view.pan, 2 * M_PI);
    const Eigen::Vector3d arm = symphony::boat_in_plane({0, 0}, theta) * symphony::kCameraOnBoat;
    x = T_world_cam.translation().x() - arm.x();
    y = T_world_cam.translation().y() - arm.y();
  }
};

void append(std::string* text, double value, int decimals) {
  *text += ", ";
  append_fixed(text, value, decimals);
}

double yaw_rate(const std::vector<SurveyFrame>& frames, size_t i) {
  if (i == 0) return 0;
  const double turn =
      std::remainder(azimuth(frames[i].T_world_cam) - azimuth(frames[i - 1].T_world_cam), 2 * M_PI);
  const double seconds = seconds_between(frames[i - 1].time, frames[i].time);
  return seconds > 0 ? turn / seconds : 0;
}

std::string image_list(const std::vector<SurveyFrame>& frames, const View& view, const Pinhole& p) {
  std::string text =
      "% t_sec, seq, x, y, theta, pan, tilt, fx, fy, cx, cy, width, height, omega, battery, rc\n";
  for (size_t i = 0; i < frames.size(); ++i) {
    const BoatBelow boat(frames[i].T_world_cam, view);
    const Eigen::Vector3d antenna =
        symphony::boat_in_plane({boat.x, boat.y}, boat.theta) * symphony::kAntennaOnBoat;
    text += to_string(frames[i].time);
    append(&text, frames[i].number, kDecimals);
    for (const double metres : {antenna.x(), antenna.y()}) append(&text, metres, kDecimals);
    for (const double angle : {boat.theta, view.pan, view.tilt}) append(&text, angle, kAngleDecimals);
    for (const double px : {p.fx, p.fy, p.cx, p.cy, double(p.width), double(p.height)})
      append(&text, px, kDecimals);
    append(&text, yaw_rate(frames, i), kDecimals);
    text += ", 0, 0\n";  // battery and remote control: none
  }
  return text;
}

// `x, y, theta` are as the boat knew them before the surveys were merged: relative to its start.
std::string pose_list(const std::vector<SurveyFrame>& frames, const View& view) {
  std::string text = "% kf, t, x, y, theta, xg, yg, thetag\n";
  const BoatBelow first(frames.front().T_world_cam, view);
  for (const SurveyFrame& frame : frames) {
    const BoatBelow boat(frame.T_world_cam, view);
    text += std::to_string(frame.number) + ", " + to_string(frame.time);
    for (const double metres : {boat.x - first.x, boat.y - first.y}) append(&text, metres, kDecimals);
    append(&text, boat.theta, kAngleDecimals);
    for (const double metres : {boat.x, boat.y}) append(&text, metres, kDecimals);
    append(&text, boat.theta, kAngleDecimals);
    text += "\n";
  }
  return text;
}

// Removes the output of an earlier writer: folders with its mark, and numbered folders of images in them.
void clear(const SurveyLocation& location) {
  std::error_code ignored;
  if (fs::exists(fs::path(location.folder()) / kMark, ignored)) fs::remove_all(location.folder(), ignored);
}

}  // namespace

std::string SurveyLocation::folder() const {
  const fs::path tree =
      newer_names ? fs::path(archive) / "Dataset" / ("20" + name.substr(0, 2)) : fs::path(archive) / "VBags";
  return (tree / name).string();
}

std::string SurveyLocation::map_folder() const { return (fs::path(archive) / "Maps" / name).string(); }

SurveyWriter::SurveyWriter(SurveyLocation location, const Camera& camera)
    : location_(std::move(location)), pinhole_(camera.pinhole()) {
  if (!is_survey_name(location_.name))
    throw InputError("survey '" + location_.name + "'", "is not a name of a survey",
                     "write its date as YYMMDD, with a letter behind if need be");
  if (!same(camera.distortion(), symphony::lens_at(camera.pinhole()).distortion))
    throw InputError(location_.folder(), "the layout has no place for this camera's lens",
                     "write the edgevo layout, or a camera without distortion");
  clear(location_);
  make_output_folder(location_.folder());
  make_output_folder(location_.map_folder());
}

void SurveyWriter::write_image(int number, const GrayImage& image) const {
  check_pixels(image, "SurveyWriter::write_image()");
  const std::string name =
      location_.newer_names ? symphony::newer_name(number) : symphony::older_name(number);
  const fs::path path = fs::path(location_.folder()) / name;
  make_output_folder(path.parent_path().string());
  cv::Mat colour;
  cv::cvtColor(cv::Mat(image.height, image.width, CV_8U, const_cast<uint8_t*>(image.pixels.data())), colour,
               cv::COLOR_GRAY2BGR);
  std::vector<uint8_t> bytes;
  cv::imencode(".jpg", colour, bytes, {cv::IMWRITE_JPEG_QUALITY, 95});
  write_file(path.string(), {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void SurveyWriter::finish(const std::vector<SurveyFrame>& frames, const std::string& source_note) const {
  if (frames.empty())
    throw InputError(location_.folder(), "there is no frame to write", "choose more frames");
  const View view = usual_view(frames);
  write_file((fs::path(location_.folder()) / symphony::kSurveyList).string(),
             image_list(frames, view, pinhole_));
  write_file((fs::path(location_.map_folder()) / "optposes.csv").string(), pose_list(frames, view));
  write_file((fs::path(location_.folder()) / kMark).string(), source_note);
}

}  // namespace edgevo
