#pragma once
// Writes a survey in the layout of Symphony Lake, as it stands in an archive, from images whose poses are
// known:
//
//   ARCHIVE/VBags/SURVEY/image_auxilliary.csv, 0000/0012.jpg ..      older copies, or
//   ARCHIVE/Dataset/20YY/SURVEY/image_auxilliary.csv, 0000/00012.jpg ..  newer ones
//   ARCHIVE/VBags/SURVEY/SOURCE.md                                   what it is; marks the folder as ours
//   ARCHIVE/Maps/SURVEY/optposes.csv
//
// The layout knows the boat in the plane and one pan and tilt of the camera: height, pitch and roll of a pose
// are lost, the rest is kept to a micrometre and a nanoradian. GPS and compass are exact here, as no survey's
// are.
#include <string>
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// Where a survey stands in an archive.
struct SurveyLocation {
  std::string archive;       ///< folder of the archive
  std::string name;          ///< YYMMDD, perhaps with a letter behind
  bool newer_names = false;  ///< of folders and images

  std::string folder() const;      ///< of list and images
  std::string map_folder() const;  ///< of optposes.csv
};

/// An image with its pose.
struct SurveyFrame {
  int number = 0;   ///< of the image
  Timestamp time;   ///< from 1970, as the archive has it
  SE3 T_world_cam;  ///< world: x east, y north, z up, metres
};

/// Writes one survey.
class SurveyWriter {
 public:
  /// Takes away what an earlier writer left under that name, and makes the folders. Throws InputError: a name
  /// that is none, a lens that the layout cannot tell, something that cannot be written.
  SurveyWriter(SurveyLocation location, const Camera& camera);
  /// A colour JPEG of quality 95. From any thread. Throws InputError.
  void write_image(int number, const GrayImage& image) const;
  /// The lists. The boat's bow is where it goes on the whole, the view is held by pan and tilt against it.
  /// Throws InputError.
  void finish(const std::vector<SurveyFrame>& frames, const std::string& source_note) const;

 private:
  SurveyLocation location_;
  Pinhole pinhole_;
};

}  // namespace edgevo
