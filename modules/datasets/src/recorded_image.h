// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Messages with images, raw or as image files.
#include <optional>
#include <string>
#include <string_view>

#include "edgevo/core/image.h"
#include "recording_topics.h"

namespace edgevo {

/// An image of a recording.
struct RecordedImage {
  /// Stamp of its header.
  Timestamp stamp;
  /// Gray levels. Of more than 8 bits without a scaling: values, no pixels.
  GrayImage image;
  /// Encoding, or format of an image file.
  std::string encoding;
};

/// Decodes a message of `topic`. `scale`: of a sequence of more than 8 bits. Throws InputError opened by
/// `where`: damage, an encoding that is not read.
RecordedImage decode_recorded(std::string_view bytes, const ImageTopic& topic,
                              const std::optional<IntensityScale>& scale, const std::string& where);

}  // namespace edgevo
