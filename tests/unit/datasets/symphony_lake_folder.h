// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Small surveys in the layout of Symphony Lake, for tests of its reader.
#include "edgevo/symphony_lake/survey_writer.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo::test {

/// Camera of 24x16 pixels at a zoom other than that of the known calibration.
inline Camera survey_camera() { return {{20, 21, 12, 8, 24, 16}, {}}; }

/// Pose of the camera, to starboard and slightly up, on a boat on a planar arc.
inline SE3 survey_pose(int i) {
  const double heading = 0.4 + 0.03 * i, view = heading - 1.55, tilt = 0.2;
  const Eigen::Vector3d forward(std::cos(view) * std::cos(tilt), std::sin(view) * std::cos(tilt),
                                std::sin(tilt));
  const Eigen::Vector3d right(std::sin(view), -std::cos(view), 0);
  Eigen::Matrix3d R;
  R.col(0) = right, R.col(1) = forward.cross(right), R.col(2) = forward;
  return {R, Eigen::Vector3d(293000 + 0.14 * i, 5445000 + 0.06 * i, 1.3)};
}

inline Timestamp survey_time(int i) { return Timestamp{14153000001234567 + 1000000 * i}; }

/// `count` images from number `first` on in ARCHIVE/VBags/NAME (or Dataset/20YY/NAME); their map in
/// ARCHIVE/Maps.
inline SurveyLocation write_survey(const std::string& archive, const std::string& name, int count,
                                   bool newer = false, int first = 998) {
  const SurveyLocation place{archive, name, newer};
  const SurveyWriter writer(place, survey_camera());
  std::vector<SurveyFrame> frames;
  for (int i = 0; i < count; ++i) {
    writer.write_image(first + i, make_image(i));
    frames.push_back({first + i, survey_time(i), survey_pose(i)});
  }
  writer.finish(frames, "# made by a test\n");
  return place;
}

}  // namespace edgevo::test
