// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Names of image files: their order in a folder, and the name for the image of a frame.
#include <string>

#include "edgevo/core/image.h"

namespace edgevo {

/// Order of the images of a folder: runs of digits compare as numbers (of any length), everything else byte
/// by byte.
bool natural_less(const std::string& a, const std::string& b);

/// `number` with at least six digits: "000012".
std::string padded_number(int number);

/// Name of the frame's file without folder and suffix; the frame number if it has no file of its own.
std::string image_name(const Frame& frame);

}  // namespace edgevo
