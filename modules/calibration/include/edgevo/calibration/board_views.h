#pragma once
// The different views of a board that a sequence of images holds.
#include <functional>
#include <vector>

#include "edgevo/calibration/board.h"
#include "edgevo/core/image_source.h"

namespace edgevo {

/// What a sequence of images shows of a board.
struct BoardViews {
  int width = 0, height = 0;     ///< of the images
  int images = 0;                ///< looked at
  int seen = 0;                  ///< in which the board is
  std::vector<BoardView> views;  ///< of these, the ones that differ, at most 60, in the order of the source
};

/// Looks at every image of `source`; its calibration is not used. A view whose corners are within two
/// hundredths of the image's width of those of one before tells nothing new and is left out, so that a video
/// may be given. `on_image` is called after each image and ends the search by returning false. Throws
/// InputError as the source does.
BoardViews collect_views(ImageSource& source, const BoardFinder& finder,
                         const std::function<bool()>& on_image);

}  // namespace edgevo
