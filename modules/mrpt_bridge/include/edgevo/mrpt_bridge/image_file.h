// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Image files to gray images and back. Folders of images and rawlogs with external images both read through
// here, so that the same file gives the same bytes on either path.
//
// Colour becomes gray by OpenCV's cvtColor weights on the decoded pixels (not by the JPEG decoder's own luma
// plane), hence a colour image embedded in a rawlog gives the same gray values as the file it was made from.
// More than 8 bits are kept with the pixels (intensities.h). The orientation tag of a JPEG is ignored:
// pixels stay as the sensor delivered them. Threads: pure functions.
#include <optional>
#include <string>

#include "edgevo/core/image.h"
#include "edgevo/mrpt_bridge/intensities.h"

namespace edgevo {

/// Reads PNG, JPEG, BMP, PGM, TIFF, ... Throws InputError for a file that is missing, truncated (PNG and JPEG
/// are checked to their end, so a half-written last image is reported rather than padded with gray) or not an
/// image. Cost: decoding, about 5 ms for a 1241x376 PNG.
/// An image of more than 8 bits is scaled by its own values.
GrayImage read_gray_image(const std::string& path);
/// The same for an image of a sequence: `scale` is that of the sequence, or nothing if its images have 8
/// bits. Throws InputError for an image of another depth, too.
GrayImage read_gray_image(const std::string& path, const std::optional<IntensityScale>& scale);
/// The values of an image of more than 8 bits; nullopt for one of 8. Throws InputError as above.
std::optional<DeepImage> read_deep_image(const std::string& path);

/// The same for an image file in memory, which `where` names in messages.
GrayImage decode_gray_image(const std::string& bytes, const std::optional<IntensityScale>& scale,
                            const std::string& where);
/// The same for an image file in memory.
std::optional<DeepImage> decode_deep_image(const std::string& bytes, const std::string& where);

/// Writes the pixels as an 8-bit gray PNG, lossless. Throws InputError (disk full, no such folder, ...); the
/// partial file is then removed, which also leaves room on a full disk to close the other files of a run.
void write_png(const std::string& path, const GrayImage& image);

}  // namespace edgevo
