// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Writes a survey in the layout of a Symphony Lake archive, from images with known poses:
//
//   ARCHIVE/VBags/SURVEY/image_auxilliary.csv, 0000/0012.jpg ..      older copies, or
//   ARCHIVE/Dataset/20YY/SURVEY/image_auxilliary.csv, 0000/00012.jpg ..  newer ones
//   ARCHIVE/VBags/SURVEY/SOURCE.md                                   what it is; marks the folder as ours
//   ARCHIVE/Maps/SURVEY/optposes.csv
//
// The layout knows the boat in the plane and one pan and tilt of the camera: height, pitch and roll of a pose
// are lost, the rest is kept to a micrometre and a nanoradian. GPS and compass are exact here, unlike in a
// real survey.
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Location of a survey in an archive.
struct SurveyLocation {
  /// Folder of the archive.
  std::string archive;
  /// Name of the survey: YYMMDD, optionally followed by a letter.
  std::string name;
  /// True: newer scheme for names of folders and images.
  bool newer_names = false;

  /// Folder of list and images.
  std::string folder() const;
  /// Folder of optposes.csv.
  std::string map_folder() const;
};

/// Number, time and pose of an image.
struct SurveyFrame {
  /// Number of the image.
  int number = 0;
  /// Time since 1970, as in the archive.
  Timestamp time;
  /// Pose in the world (x east, y north, z up), metres.
  SE3 T_world_cam;
};

/// Writes one survey.
class SurveyWriter {
 public:
  /// Removes what an earlier writer left under that name, and creates the folders. Throws InputError: an
  /// invalid name, a lens that the layout cannot represent, something that cannot be written.
  SurveyWriter(SurveyLocation location, const Camera& camera);
  /// Writes a colour JPEG of quality 95. Any thread. Throws InputError.
  void write_image(int number, const GrayImage& image) const;
  /// Writes the lists. The boat's bow points along its mean motion, and pan and tilt hold the view relative
  /// to it. Throws InputError.
  void finish(const std::vector<SurveyFrame>& frames, const std::string& source_note) const;

 private:
  SurveyLocation location_;
  Pinhole pinhole_;
};

}  // namespace edgevo
