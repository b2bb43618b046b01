#pragma once
// The images of one camera of a rawlog, as an ImageSource.
//
// Read are CObservationImage, the left image of CObservationStereoImages and the intensity image of
// CObservation3DRangeScan, embedded or stored externally, in both rawlog formats (rawlog_reader.h).
// Calibration and mount come from the camera's first observation. Times are exact to the tick.
//
// External images: the folder is `<rawlog without suffix>_Images`, `_images`, `_IMAGES` or `Images` beside
// the rawlog (MRPT 2.5.8's own detectImagesDirectory finds it only from inside that folder). They are decoded
// by read_gray_image(), hence give the same bytes as a folder of the same files.
//
// Opening reads the rawlog once (at most 256 MB of it, images left alone), to know labels, number of frames
// and whether the checksum is right; a longer rawlog has no size(), and a second camera that turns up later
// is told then. Memory: one observation at a time.
#include <memory>
#include <optional>
#include <string>

#include "edgevo/core/image_source.h"

namespace edgevo {

/// Which images of which rawlog.
struct RawlogSourceOptions {
  std::string path;  ///< of the rawlog
  std::string sensor_label;      ///< which camera; may be empty if the rawlog has only one
  std::optional<Camera> camera;  ///< calibration to use in place of the observations'
};

/// Throws InputError: no such file, wrong checksum, no image in it, several cameras and no label (the message
/// lists them), an unknown label, a calibration that is missing or of a lens model other than plumb-bob, no
/// folder with the external images. next() throws InputError for a missing image file, an image without time,
/// times that do not increase, a size that is not the camera's, a calibration that changes, a rawlog that is
/// cut short or holds an unknown class; always after the frames before.
std::unique_ptr<ImageSource> open_rawlog(const RawlogSourceOptions& options);

}  // namespace edgevo
