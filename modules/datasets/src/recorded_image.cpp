// SPDX-License-Identifier: BSD-3-Clause
#include "recorded_image.h"

#include "edgevo/mrpt_bridge/image_file.h"
#include "edgevo/recordings/image_pixels.h"

namespace edgevo {
namespace {

void check_format(const CompressedImageMessage& message, const std::string& where) {
  const bool is_jpeg = message.file.substr(0, 2) == "\xFF\xD8",
             is_png = message.file.substr(0, 4) == "\x89PNG";
  if (message.format.find("compressedDepth") == std::string::npos && (is_jpeg || is_png)) return;
  throw InputError(where, "compressed images of the format '" + message.format + "' are not read",
                   "JPEG and PNG are");
}

GrayImage decode_file(const std::string& file, const std::optional<IntensityScale>& scale,
                      const std::string& where) {
  if (scale) return decode_gray_image(file, scale, where);
  const auto deep = decode_deep_image(file, where);
  if (!deep) return decode_gray_image(file, scale, where);
  GrayImage image{deep->width, deep->height, {}};
  image.values = deep->values;
  return image;
}

GrayImage with_scale(GrayImage image, const std::optional<IntensityScale>& scale, const std::string& where) {
  if (!scale) return image;
  if (!image.is_deep()) throw InputError(where, "the image has 8 bits, but the first images have 16", "");
  return with_pixels({image.width, image.height, std::move(image.values)}, *scale);
}

}  // namespace

RecordedImage decode_recorded(std::string_view bytes, const ImageTopic& topic,
                              const std::optional<IntensityScale>& scale, const std::string& where) {
  if (!topic.is_compressed) {
    const ImageMessage message = decode_image(bytes, topic.serialization, where);
    return {message.header.stamp, with_scale(gray_image(message, where), scale, where), message.encoding};
  }
  const CompressedImageMessage message = decode_compressed_image(bytes, topic.serialization, where);
  check_format(message, where);
  return {message.header.stamp, decode_file(std::string(message.file), scale, where), message.format};
}

}  // namespace edgevo
