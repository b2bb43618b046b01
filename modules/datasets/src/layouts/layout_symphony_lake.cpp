// SPDX-License-Identifier: BSD-3-Clause
// Symphony Lake: SURVEY/{image_auxilliary.csv, 0012/0345.jpg}, Maps/SURVEY/optposes.csv; a boat whose camera
// looks at the bank.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "assumed_camera.h"
#include "camera_numbers.h"
#include "edgevo/core/error.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/output_file.h"
#include "edgevo/symphony_lake/survey_geometry.h"
#include "layout.h"
#include "symphony_archive.h"
#include "symphony_lists.h"
#include "tum_text.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

constexpr int kAllColumns = 16;
constexpr double kSameTilt = 1e-3;     // radians of tilt: less than a pixel of this camera
constexpr double kSteadyMount = 0.02;  // radians: about a degree, the levelness of a map's axes
constexpr double kZoomed_px = 1;       // error at the image border up to which one camera serves all rows

std::string list_path(const std::string& folder) {
  return (fs::path(folder) / symphony::kSurveyList).string();
}

bool is_symphony_layout(const std::string& folder) { return !existing(list_path(folder)).empty(); }

// ---- rows ----

double usual_tilt(const SurveyRows& survey) {
  std::vector<double> tilts;
  for (const SurveyRow& row : survey.rows) tilts.push_back(row.tilt);
  return median(std::move(tilts));
}

// Removes the leading rows in which the camera has not yet reached its usual tilt; returns how many.
int remove_rows_before_usual_tilt(SurveyRows* survey) {
  if (!survey->has_view) return 0;
  const double usual = usual_tilt(*survey);
  const auto at_usual_tilt = [&](const SurveyRow& row) { return std::abs(row.tilt - usual) < kSameTilt; };
  const auto first = std::find_if(survey->rows.begin(), survey->rows.end(), at_usual_tilt);
  const int count = int(first - survey->rows.begin());
  survey->rows.erase(survey->rows.begin(), first);
  return count;
}

std::string describe_rows(const SurveyRows& survey, int skipped) {
  std::string text = std::to_string(survey.rows.size() + size_t(skipped)) + " of " +
                     std::to_string(survey.columns) + " columns";
  if (survey.columns < kAllColumns) text += " (newer surveys have 16)";
  if (skipped == 0) return text;
  return text + "; the first " + std::to_string(skipped) +
         " are skipped: the camera had not yet reached its tilt of " + fixed(survey.rows.front().tilt, 4) +
         " rad";
}

int missing_numbers(const SurveyRows& survey) {
  int missing = 0;
  for (size_t i = 1; i < survey.rows.size(); ++i)
    missing += std::max(0, survey.rows[i].number - survey.rows[i - 1].number - 1);
  return missing;
}

// The rows selected by --frames: [begin, end).
std::pair<size_t, size_t> played(const SurveyRows& survey, const SourceOptions& options) {
  const size_t count = survey.rows.size();
  const size_t begin = std::min(size_t(std::max(0, options.first)), count - 1);
  const size_t end = options.last ? std::min(size_t(std::max(0, *options.last)), count) : count;
  return {begin, std::max(end, begin + 1)};
}

// ---- images ----

using NameOf = std::string (*)(int number);

// The naming scheme under which the first existing image is found.
NameOf naming_of(const std::string& folder, const SurveyRows& survey) {
  for (const SurveyRow& row : survey.rows)
    for (const NameOf name : {symphony::older_name, symphony::newer_name})
      if (!existing((fs::path(folder) / name(row.number)).string()).empty()) return name;
  const int first = survey.rows.front().number;
  throw InputError(folder,
                   "none of its " + std::to_string(survey.rows.size()) + " images is there, neither as " +
                       symphony::older_name(first) + " nor as " + symphony::newer_name(first),
                   "put the folders of the images next to " + std::string(symphony::kSurveyList));
}

// ---- camera ----

Pinhole pinhole_of(const SurveyRow& row, const std::string& where) {
  return {row.fx, row.fy, row.cx, row.cy, image_side(row.width, where), image_side(row.height, where)};
}

// True if one camera fits both rows.
bool alike(const SurveyRow& a, const SurveyRow& b) {
  return a.width == b.width && a.height == b.height &&
         std::abs(a.fx / b.fx - 1) * 0.5 * b.width < kZoomed_px &&
         std::abs(a.fy / b.fy - 1) * 0.5 * b.height < kZoomed_px && std::abs(a.cx - b.cx) < kZoomed_px &&
         std::abs(a.cy - b.cy) < kZoomed_px;
}

Camera camera_of_rows(const SurveyRows& survey, const SourceOptions& options, Details* details) {
  const auto [begin, end] = played(survey, options);
  const SurveyRow& first = survey.rows[begin];
  Camera camera;
  camera.set_pinhole(pinhole_of(first, survey.where(first)));
  camera.check(survey.where(first));
  for (size_t i = begin; i < end; ++i)
    if (!alike(survey.rows[i], first))
      throw InputError(survey.where(survey.rows[i]),
                       "the camera differs from that of the rows before: fx " + fixed(survey.rows[i].fx, 2) +
                           " instead of " + fixed(first.fx, 2) + " (it zooms)",
                       "play the rows before it with --frames " + std::to_string(begin) + ":" +
                           std::to_string(i) + ", or give one camera for all with --camera");
  const symphony::Lens lens = symphony::lens_at(camera.pinhole());
  camera.set_distortion(lens.distortion);
  details->emplace_back("lens", lens.says);
  return camera;
}

// The mount, if pan and tilt are constant; a camera that turns on the boat has none.
std::optional<SE3> steady_mount(const SurveyRows& survey, const SourceOptions& options) {
  if (!survey.has_view) return std::nullopt;
  const auto [begin, end] = played(survey, options);
  const SurveyRow& middle = survey.rows[(begin + end) / 2];
  for (size_t i = begin; i < end; ++i)
    if (std::abs(survey.rows[i].pan - middle.pan) > kSteadyMount ||
        std::abs(survey.rows[i].tilt - middle.tilt) > kSteadyMount)
      return std::nullopt;
  return symphony::camera_on_boat(middle.pan, middle.tilt);
}

VehicleTrack gps_track(const SurveyRows& survey) {
  VehicleTrack track;
  if (!survey.has_position) return track;
  track.sensor_on_vehicle = symphony::kAntennaOnBoat;
  for (const SurveyRow& row : survey.rows) track.positions.push_back({row.time, {row.x, row.y, 0}});
  return track;
}

// ---- ground truth ----

std::string describe_truth(const std::string& folder, const SurveyRows& survey) {
  const std::string map = survey_map(folder);
  const std::string missing = "no Maps/" + survey_name(folder) + "/optposes.csv";
  if (!survey.has_view) return "none: the rows do not state where the camera looks";
  if (!map.empty())
    return map + " (poses of the boat in the plane, laser and GPS, with pan and tilt of the camera)";
  if (!survey.has_position) return "none: " + missing + ", and the rows have no x, y, theta";
  return "coarse, by GPS and compass (x, y, theta of " + std::string(symphony::kSurveyList) + "): " + missing;
}

// Pose of the boat by its GPS antenna and compass.
BoatPose coarse_pose(const SurveyRow& row) {
  const Eigen::Vector3d antenna = symphony::boat_in_plane({0, 0}, row.theta) * symphony::kAntennaOnBoat;
  return {row.time, Eigen::Vector2d(row.x, row.y) - antenna.head<2>(), row.theta};
}

// The boat at the time of each row.
std::vector<std::optional<BoatPose>> boats_of(const std::string& folder, const SurveyRows& survey) {
  std::vector<std::optional<BoatPose>> boats;
  if (const std::string map = survey_map(folder); !map.empty()) {
    const std::vector<BoatPose> poses = read_boat_poses(map);
    for (const SurveyRow& row : survey.rows) boats.push_back(boat_at(poses, row.time));
  } else if (survey.has_position) {
    for (const SurveyRow& row : survey.rows) boats.emplace_back(coarse_pose(row));
  }
  return boats;
}

// World: x east, y north, z up, its origin where the boat is first known: coordinates of a national grid
// would leave no digits for metres.
std::string symphony_ground_truth(const SourceOptions& options) {
  SurveyRows survey = read_survey_rows(list_path(options.path));
  if (!survey.has_view) return {};
  remove_rows_before_usual_tilt(&survey);
  const auto boats = boats_of(options.path, survey);
  std::optional<Eigen::Vector2d> origin;
  std::string poses;
  for (size_t i = 0; i < boats.size(); ++i) {
    if (!boats[i]) continue;
    if (!origin) origin = boats[i]->position;
    const SE3 T_world_boat = symphony::boat_in_plane(boats[i]->position - *origin, boats[i]->heading);
    append_pose(&poses, survey.rows[i].time,
                T_world_boat * symphony::camera_on_boat(survey.rows[i].pan, survey.rows[i].tilt));
  }
  if (poses.empty()) return {};
  return "# Symphony Lake ground truth as TUM: timestamp tx ty tz qx qy qz qw (T_world_cam); " +
         describe_truth(options.path, survey) + "\n" + poses;
}

// ---- all of it ----

Camera survey_camera(const SurveyRows& survey, const SourceOptions& options, Sequence* sequence) {
  const SeenImages images = seen_images(sequence->images);
  if (!options.camera_file.empty())
    return camera_of_file(camera_file_of(options, ""), images, &sequence->decisions);
  if (survey.has_camera) return camera_of_rows(survey, options, &sequence->details);
  if (options.fov_deg || options.any_camera)
    return choose_or_assume_camera(options, "", images, &sequence->decisions);
  throw InputError(
      survey.path,
      "its " + std::to_string(survey.columns) + " columns are fewer than the 13 that include the camera",
      "give the camera's file with --camera");
}

Sequence read_symphony_layout(const SourceOptions& options) {
  SurveyRows survey = read_survey_rows(list_path(options.path));
  const int skipped = remove_rows_before_usual_tilt(&survey);
  Sequence sequence;
  sequence.kind = "Symphony Lake";
  const NameOf name = naming_of(options.path, survey);
  for (const SurveyRow& row : survey.rows) {
    sequence.images.push_back((fs::path(options.path) / name(row.number)).string());
    sequence.times.push_back(row.time);
  }
  sequence.details.emplace_back("survey", survey_name(options.path));
  sequence.details.emplace_back("rows", describe_rows(survey, skipped));
  if (const int missing = missing_numbers(survey); missing > 0)
    sequence.details.emplace_back("missing numbers", std::to_string(missing) + " images have no row");
  sequence.camera = survey_camera(survey, options, &sequence);
  sequence.T_vehicle_cam = steady_mount(survey, options);
  sequence.gps = gps_track(survey);
  sequence.details.emplace_back("ground truth", describe_truth(options.path, survey));
  return sequence;
}

}  // namespace

Layout symphony_layout() { return {is_symphony_layout, read_symphony_layout, false, symphony_ground_truth}; }

}  // namespace edgevo
