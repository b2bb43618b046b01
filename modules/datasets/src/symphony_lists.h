#pragma once
// The two lists of a Symphony Lake survey: image_auxilliary.csv (a row for each image) and optposes.csv
// (poses of the boat). Fields between commas; lines that begin with % are header and comments.
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "edgevo/core/timestamp.h"

namespace edgevo {

/// Columns that are read, in the order in which a survey without a header has them. Behind them stand omega,
/// battery and rc.
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
  int line = 0;  ///< of the file, from 1
  Timestamp time;
  int number = 0;                         ///< of the image
  double x = 0, y = 0, theta = 0;         ///< GPS, metres; compass, radians from x (east) to the left
  double pan = 0, tilt = 0;               ///< radians (symphony_lake/survey_geometry.h)
  double fx = 0, fy = 0, cx = 0, cy = 0;  ///< pixels
  double width = 0, height = 0;
};

struct SurveyRows {
  std::string path;
  int columns = 0;                                                  ///< of each row; 16 in newer surveys
  bool has_position = false, has_view = false, has_camera = false;  ///< x, y, theta; pan, tilt; fx to height
  std::vector<SurveyRow> rows;

  std::string where(const SurveyRow& row) const { return path + ", line " + std::to_string(row.line); }
};

/// Columns go by the names in the header, where there is one. What a survey lacks stays 0. Throws InputError:
/// no time or no number of the image in the columns, a row with another number of columns than the first, a
/// field that is no number, no row at all.
SurveyRows read_survey_rows(const std::string& path);

struct BoatPose {
  Timestamp time;
  Eigen::Vector2d position;  ///< of the boat, metres
  double heading = 0;        ///< radians from x (east) to the left
};

/// xg, yg, thetag over t. Throws InputError: fewer than eight columns, a field that is no number, times that
/// do not increase, no row.
std::vector<BoatPose> read_boat_poses(const std::string& path);

/// The boat at `time`, between the poses around it; nullopt unless one of them is at most 0.1 s away. Cost:
/// logarithmic.
std::optional<BoatPose> boat_at(const std::vector<BoatPose>& poses, Timestamp time);

}  // namespace edgevo
