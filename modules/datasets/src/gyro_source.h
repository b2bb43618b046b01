// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A source with the gyro that the user gave, or that lies next to it.
#include <memory>

#include "edgevo/core/image_source.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

/// `inner` with the gyro of options.gyro, without any for "off", or as it is, with the file next to it if it
/// has no gyro of its own. What was decided is said. Throws InputError for a file that cannot be used; one
/// that only lies next to the images is then not used, and that is said.
std::unique_ptr<ImageSource> with_gyro(std::unique_ptr<ImageSource> inner, const SourceOptions& options);

}  // namespace edgevo
