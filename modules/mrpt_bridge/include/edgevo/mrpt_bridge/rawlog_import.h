#pragma once
// Any ImageSource to a rawlog that the stock MRPT tools play: observations only, one CObservationImage a
// frame, its image stored externally as an 8-bit gray PNG in `<OUT without suffix>_Images/` under its own
// name (its number, where it was no file of its own). Lossless:
// pixels, times and calibration come back bit for bit. RawLogViewer and rawlog-edit of MRPT 2.5.8 find the
// images when started in the folder of the rawlog.
#include <functional>
#include <string>

#include "edgevo/core/image_source.h"

namespace edgevo {

/// Called after each frame with the number written so far.
using ImportProgress = std::function<void(int)>;

/// Writes all frames of `source` and returns how many. The sensor label is the source's, else CAM0; the mount
/// is the source's, else a camera that looks straight ahead. A ground truth beside the source is not copied:
/// see cmd_import. Throws InputError if a file cannot be written (disk full) and for a frame that the source
/// refuses; the rawlog then holds all frames before it and is closed properly.
int import_rawlog(ImageSource& source, const std::string& rawlog_path, const ImportProgress& progress = {});

}  // namespace edgevo
