// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The images of a folder in their order, and which of them belong together: a folder may hold those of two
// cameras, or masks and depths with the images. Played as one sequence they would be a zigzag.
//
// Names of one series differ in their numbers only. Their pattern has `#` for each number:
// "left_000017.png" is one of "left_#.png".
#include <string>
#include <vector>

#include "edgevo/datasets/open_source.h"
#include "sequence.h"

namespace edgevo {

/// Paths of the images of a folder that --images selects, else of its only series, by name; numbers in names
/// by value ("frame_9" before "frame_10"). Hidden files (also what macOS writes next to a file, "._NAME") are
/// no images. What is skipped is added to `decisions` (may be nullptr). Throws InputError if there are no
/// images, or if there are several series; a caller that needs no sequence (any_camera) gets them all.
std::vector<std::string> list_images(const std::string& folder, const SourceOptions& options,
                                     Decisions* decisions);

/// Pattern of the series of a file name.
std::string pattern_of(const std::string& name);

/// Whether a name matches a pattern: `#` is any number, `*` any text, `?` any character.
bool matches(const std::string& name, const std::string& pattern);

}  // namespace edgevo
