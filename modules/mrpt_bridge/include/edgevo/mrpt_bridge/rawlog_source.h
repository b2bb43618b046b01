// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The images of one camera of a rawlog, as an ImageSource.
//
// Read are CObservationImage, the left image of CObservationStereoImages and the intensity image of
// CObservation3DRangeScan, embedded or stored externally, in both rawlog formats (rawlog_reader.h).
// Calibration and mount come from the camera's first observation. Times are exact to the tick.
//
// External images: the folder is `<rawlog without suffix>_Images`, `_images`, `_IMAGES` or `Images` next to
// the rawlog (MRPT 2.5.8's own detectImagesDirectory finds it only from inside that folder). They are decoded
// by read_gray_image() and hence give the same bytes as a folder of the same files.
//
// Opening reads the rawlog once (at most 256 MB of it, without its images) for labels, number of frames and
// checksum; a longer rawlog has no size(), and a second camera that appears later is reported then. Memory:
// one observation at a time.
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/image_source.h"

namespace edgevo {

/// Selects the images of one camera in a rawlog.
struct RawlogSourceOptions {
  /// Path of the rawlog.
  std::string path;
  /// Label of the camera; may be empty if the rawlog has only one.
  std::string sensor_label;
  /// Calibration that replaces that of the observations.
  std::optional<Camera> camera;
  /// What was decided about that calibration, for decisions().
  std::vector<InputDecision> decisions = {};
  /// Number of significant bits of images of more than 8 (intensities.h); 0: from the images.
  int bits = 0;
};

/// Width and height of the camera's first image, pixels; zeros if it has none or it does not decode.
std::pair<int, int> first_image_size(const RawlogSourceOptions& options);

/// Opens the source. Throws InputError: no such file, wrong checksum, no images, several cameras and no label
/// (the message lists them), an unknown label, a calibration that is missing or has a lens model other than
/// plumb-bob, no folder with the external images. next() throws BadFrame for a missing image file, a time
/// that is missing or does not increase (core/time_order.h), a size that differs from the camera's; and
/// InputError for a calibration that changes, a rawlog that is truncated or holds an unknown class; always
/// after the frames before it.
std::unique_ptr<ImageSource> open_rawlog(const RawlogSourceOptions& options);

}  // namespace edgevo
