// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The two lists of a Symphony Lake survey: image_auxilliary.csv (a row for each image) and optposes.csv
// (poses of the boat). Fields between commas; lines that begin with % are header and comments.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Columns that are read, in the order of a survey without a header. The columns omega, battery and rc follow
/// them.
enum class SurveyColumn {
  kTime,
  kNumber,
  kX,
  kY,
  kTheta,
  kPan,
  kTilt,
  kFx,
  kFy,
  kCx,
  kCy,
  kWidth,
  kHeight,
  kCount
};

struct SurveyRow {
  /// Line number in the file, from 1.
  int line = 0;
  Timestamp time;
  /// Number of the image.
  int number = 0;
  /// GPS position, metres, and compass heading, radians from x (east) to the left.
  double x = 0, y = 0, theta = 0;
  /// Pan and tilt of the camera, radians (symphony_lake/survey_geometry.h).
  double pan = 0, tilt = 0;
  /// Focal lengths and principal point, pixels.
  double fx = 0, fy = 0, cx = 0, cy = 0;
  double width = 0, height = 0;
};

struct SurveyRows {
  std::string path;
  /// Number of columns in each row; 16 in newer surveys.
  int columns = 0;
  /// True if the rows have x, y and theta; pan and tilt; fx to height.
  bool has_position = false, has_view = false, has_camera = false;
  std::vector<SurveyRow> rows;

  std::string where(const SurveyRow& row) const { return path + ", line " + std::to_string(row.line); }
};

/// Reads the rows. Columns are identified by the names in the header, if there is one. Missing columns stay
/// 0. Throws InputError: no time or no image number in the columns, a row with a different number of columns
/// than the first, a field that is not a number, no rows at all.
SurveyRows read_survey_rows(const std::string& path);

struct BoatPose {
  Timestamp time;
  /// Position of the boat, metres.
  Eigen::Vector2d position;
  /// Heading, radians from x (east) to the left.
  double heading = 0;
};

/// Reads xg, yg, thetag by time t. Throws InputError: fewer than eight columns, a field that is not a number,
/// times that do not increase, no rows.
std::vector<BoatPose> read_boat_poses(const std::string& path);

/// Pose of the boat at `time`, interpolated between its neighbours; nullopt unless one of them is at most 0.1
/// s away. Cost: logarithmic.
std::optional<BoatPose> boat_at(const std::vector<BoatPose>& poses, Timestamp time);

}  // namespace edgevo
