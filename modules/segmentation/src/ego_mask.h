// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The mask of what is fixed to the camera, in raw images: given as a file, found (cell_labels.h), or both.
#include <memory>
#include <string>

#include "edgevo/core/rectification.h"
#include "edgevo/edges/image_correction.h"
#include "edgevo/edges/plane.h"

namespace edgevo {

/// Reads a mask for images of a size: 255 where the file is black, else 0. A file of the same shape is scaled
/// to it. Throws InputError if the file cannot be read, has another shape, or leaves nothing or everything
/// out.
Plane<uint8_t> read_mask(const std::string& path, int width, int height);

/// An area of level `level` of the rectified images in the raw ones.
Plane<uint8_t> raw_area(const Plane<uint8_t>& area, int level, const Rectification& rectification,
                        const ImageCorrection& correction);

/// Size of the images of one level of the pyramids, pixels, and its number.
struct LevelSize {
  int width, height, level;
};

/// An area of raw images in a level of the rectified ones, the inverse of raw_area(): 255 there, else 0.
Plane<uint8_t> level_area(const Plane<uint8_t>& raw, const LevelSize& size,
                          const Rectification& rectification, const ImageCorrection& correction);

/// The union of what is given and what was found.
class EgoMask {
 public:
  /// `path`: a file for read_mask(); empty: nothing is given.
  EgoMask(const std::string& path, int width, int height);
  /// Replaces what was found.
  void set_found(Plane<uint8_t> found);
  /// Removes what was found.
  void clear_found() { all_ = given_; }
  /// What was given; null if nothing.
  const std::shared_ptr<const Plane<uint8_t>>& given() const { return given_; }
  /// 255 on parts that are fixed to the camera, else 0; null if there are none. The same object until it
  /// changes.
  const std::shared_ptr<const Plane<uint8_t>>& mask() const { return all_; }

 private:
  std::shared_ptr<const Plane<uint8_t>> given_, all_;
};

}  // namespace edgevo
