// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Converts any ImageSource to a rawlog that the stock MRPT tools play: observations only, one
// CObservationImage a frame, and what its other sensors measured (sensor_observations.h); its image stored
// externally as an 8-bit gray PNG in `<OUT without suffix>_Images/` under its own name (its frame number if
// it was not a file). Lossless: pixels, times and calibration are read back bit by bit. RawLogViewer and
// rawlog-edit of MRPT 2.5.8 find the images when started in the folder of the rawlog.
#include <functional>
#include <string>

#include "edgevo/core/image_source.h"

namespace edgevo {

/// Called after each frame with the number of frames written.
using ImportProgress = std::function<void(int)>;

/// Writes all frames of `source` and returns their number. The sensor label is the source's, else CAM0; the
/// mount is the source's, else that of a camera that looks straight ahead. Ground truth of the source is not
/// copied: see cmd_import. Throws InputError if a file cannot be written (disk full) and for a frame that the
/// source rejects; the rawlog then holds all frames before it and is closed properly.
int import_rawlog(ImageSource& source, const std::string& rawlog_path, const ImportProgress& progress = {});

}  // namespace edgevo
