// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Is an image one exposure? Drivers hand out buffers that are still being written, so that a part is of the
// image that was in the buffer before; video is interlaced; a raw mosaic of colours is taken for gray;
// images are repeated or black. Whatever follows takes all rows of an image for one time.
#include <array>
#include <vector>

#include "edgevo/core/frame_evidence.h"
#include "edgevo/core/image.h"

namespace edgevo {

/// Rows begin .. end - 1 of an image; empty: none.
struct ImageRows {
  /// First row, and the one after the last.
  int begin = 0, end = 0;
  /// Whether there are none.
  bool empty() const { return begin >= end; }
  /// Number of rows.
  int size() const { return end - begin; }
};

/// What the pixels of an image show of its exposure.
struct ImageExposure {
  /// What is wrong with it.
  ImageFault fault = ImageFault::kNone;
  /// Of a torn image the rows of the raw image that are of an earlier image.
  ImageRows old_rows;
};

/// Follows the raw images of one camera. Exact: the noise of a sensor does not repeat. What is fixed to the
/// camera or stands still in a rendering repeats in more than one image, and is no fault.
class ExposureCheck {
 public:
  /// Adds the next image. Only the first of several that are blank or repeated in a row is a fault: then
  /// something hides the view, or the camera stands. Cost: about 0.3 ms at 1241x376.
  ImageExposure add(const GrayImage& image);
  /// kInterlaced or kMosaic if the stream is: two images in a row were; else kNone.
  ImageFault pattern() const { return pattern_; }

 private:
  bool is_blank(const GrayImage& image);
  // An earlier image; of the newest image that was compared with that of its time, the rows that were its;
  // empty: none was.
  struct Earlier {
    std::vector<uint8_t> pixels;
    std::vector<bool> equal;
  };
  static ImageRows rows_of(Earlier* earlier, const ImageView<uint8_t>& image);
  void keep(const std::vector<uint8_t>& pixels);

  static constexpr size_t kBuffers = 4;  // images: drivers of cameras rarely ask for more buffers

  std::array<Earlier, kBuffers> before_;  // the last images, the newest first
  int width_ = 0, height_ = 0;            // theirs
  double contrast_ = 0;                   // of the last image that is not blank, steps of its values
  bool was_blank_ = false;
  ImageFault newest_pattern_ = ImageFault::kNone, pattern_ = ImageFault::kNone;
};

/// The image with every second row, from the second one on, replaced by the mean of its neighbours.
GrayImage first_field(const GrayImage& image);

/// The gray image of a mosaic of colours, of which every second pixel and row is of another one (Bayer).
GrayImage without_mosaic(const GrayImage& image);

}  // namespace edgevo
