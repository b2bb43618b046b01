// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// From the camera that takes the images to the pinhole camera in which the method works.
#include <optional>
#include <vector>

#include "edgevo/core/camera.h"

namespace edgevo {

/// Lookup tables from each pixel of a rectified image, row by row, to the raw one.
struct RectificationMaps {
  /// Size of the rectified image, pixels.
  int width = 0, height = 0;
  /// Position in the raw image, width * height each, pixels; may lie outside it, and NaN where the lens shows
  /// nothing at all.
  std::vector<float> x, y;
  /// 255 at pixels without a source, else 0, width * height; empty if all have one.
  std::vector<uint8_t> missing;
};

/// A camera with the pinhole that its images are rectified to, which has a size and a focal length of its
/// own. Holds no tables: cheap to copy.
class Rectification {
 public:
  /// Of no camera: to be assigned to.
  Rectification() = default;
  /// The usual pinhole (target_pinhole.h). That of a lens without or with plumb-bob distortion keeps focal
  /// lengths, principal point and size, and loses what the lens shows beyond them; where it reaches beyond
  /// the raw image, border pixels are repeated and edges found among them: only pixels beyond max_angle()
  /// count as missing.
  Rectification(const Camera& camera);
  /// The same for a camera without distortion.
  Rectification(const Pinhole& pinhole) : Rectification(Camera(pinhole)) {}
  /// To a given pinhole. Pixels that show what is outside the raw image are missing too.
  Rectification(const Camera& camera, const Pinhole& target);

  /// The camera that takes the images.
  const Camera& camera() const { return camera_; }
  /// The camera of the rectified images.
  const Pinhole& target() const { return target_; }
  /// Whether raw images need no change.
  bool is_identity() const { return !camera_.has_distortion() && camera_.pinhole() == target_; }
  /// Raw pixel that the camera file gives for the normalised image point x_file (ImageCorrection), which may
  /// lie outside the image; NaN where the lens shows nothing.
  Eigen::Vector2d raw_pixel(const Eigen::Vector2d& x_file) const;
  /// Tables for images whose lens differs from the file's by `lens`. With another focal length, pixels that
  /// show what is outside the raw image are missing too. Cost: one projection a pixel.
  RectificationMaps maps(const ImageCorrection& lens = {}) const;
  /// Throws InputError naming `where` for an unusable camera or target.
  void check(const std::string& where) const;

 private:
  bool is_outside(const Eigen::Vector2d& raw) const;

  Camera camera_;
  Pinhole target_;
  bool masks_outside_ = false;
};

/// From a camera to the requested pinhole; nothing: the default one.
inline Rectification rectification_of(const Camera& camera, const std::optional<Pinhole>& target) {
  return target ? Rectification(camera, *target) : Rectification(camera);
}

}  // namespace edgevo
