#pragma once
// Names of image files: their order in a folder, and what the image of a frame is to be called.
#include <string>

#include "edgevo/core/image.h"

namespace edgevo {

/// The order in which images of a folder are played: runs of digits compare as numbers (of any length), all
/// else byte by byte.
bool natural_less(const std::string& a, const std::string& b);

/// Six digits or more: "000012".
std::string padded_number(int number);

/// The name of the frame's file without folder and suffix; its number where it was no file of its own.
std::string image_name(const Frame& frame);

}  // namespace edgevo
