// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The distinct views of a board in a sequence of images.
#include <functional>
#include <string>
#include <vector>

#include "edgevo/calibration/board.h"
#include "edgevo/core/image_source.h"

namespace edgevo {

/// Distinct views of a board in a sequence of images.
struct BoardViews {
  /// Size of the images, pixels.
  int width = 0, height = 0;
  /// Number of images searched.
  int images = 0;
  /// Number of images in which the board was found.
  int seen = 0;
  /// The distinct views among these, at most 60, in the order of the source.
  std::vector<BoardView> views;
  /// Names and sizes of the images that were skipped because they differ in size from most.
  std::vector<std::string> of_other_size = {};
};

/// Searches every image of `source`; its calibration is not used. A view whose corners are within 2 % of the
/// image width of those of an earlier view adds nothing and is skipped, so that a video may be given.
/// Images of another size than most are skipped. `on_image` is called after each image; returning false
/// ends the search. Throws InputError as the source does, and if no size is that of more than half of the
/// images.
BoardViews collect_views(ImageSource& source, const BoardFinder& finder,
                         const std::function<bool()>& on_image);

}  // namespace edgevo
