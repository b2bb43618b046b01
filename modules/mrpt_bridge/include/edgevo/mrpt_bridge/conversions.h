// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Conversion between the types of core and those of MRPT, lossless but for lenses that MRPT does not know.
//
// Poses keep their meaning: SE3 T_a_b and CPose3D both map coordinates from b to a. Times are integers of the
// same tick (100 ns) and differ only in their epoch, so they pass through unchanged; MRPT's own fromDouble
// would round to 0.24 us. Pixel convention and coefficients of lenses are the same on both sides (OpenCV's).
// Cost: only images are copied. Threads: pure functions.
#include <mrpt/core/Clock.h>
#include <mrpt/img/CImage.h>
#include <mrpt/img/TCamera.h>
#include <mrpt/poses/CPose3D.h>

#include <optional>
#include <string>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"
#include "edgevo/mrpt_bridge/intensities.h"

namespace edgevo {

/// The same rigid motion as an MRPT pose.
mrpt::poses::CPose3D to_mrpt(const SE3& T_a_b);
/// The same rigid motion as an SE3.
SE3 from_mrpt(const mrpt::poses::CPose3D& T_a_b);

/// The same instant, exact for every tick; MRPT counts from 1601 (its "no time" is tick 0 of that epoch).
mrpt::Clock::time_point to_mrpt(Timestamp t);
/// The same instant, exact for every tick.
Timestamp from_mrpt(mrpt::Clock::time_point t);

/// A camera of MRPT that is used for another.
struct ClosestMrptCamera {
  /// The camera.
  mrpt::img::TCamera camera;
  /// Largest distance between the pixels of both for a ray, over the image; 0: the same camera.
  double max_error_px = 0;
};

/// The camera as MRPT can hold it: a lens without or with plumb-bob distortion as plumb_bob, zeros included,
/// any other as the closest of kannala_brandt.
ClosestMrptCamera closest_mrpt(const Camera& camera);
/// The same. Throws InputError for a lens of which that is more than half a pixel off.
mrpt::img::TCamera to_mrpt(const Camera& camera);
/// The same camera; plumb_bob with k4, k5 or k6 is the rational model. Throws InputError, opened by `where`
/// (file and observation), for values that Camera::check rejects.
Camera from_mrpt(const mrpt::img::TCamera& camera, const std::string& where);

/// A deep copy of the pixels as an 8-bit gray CImage. Throws InputError unless it has width * height pixels.
mrpt::img::CImage to_mrpt(const GrayImage& image);
/// Pixels of an image in memory (for one stored externally see rawlog_source.h). Colour is converted to gray
/// with OpenCV's weights, and more than 8 bits are scaled by `scale`, exactly as read_gray_image() does.
/// Throws InputError for an empty image or one of another depth.
GrayImage from_mrpt(const mrpt::img::CImage& image, const std::optional<IntensityScale>& scale,
                    const std::string& where);
/// The same for images of 8 bits.
inline GrayImage from_mrpt(const mrpt::img::CImage& image, const std::string& where) {
  return from_mrpt(image, std::nullopt, where);
}
/// The values of an image in memory of more than 8 bits; nullopt for one of 8. Throws InputError as above.
std::optional<DeepImage> deep_from_mrpt(const mrpt::img::CImage& image, const std::string& where);

/// Mount of a camera at the vehicle's origin that looks straight ahead: p_vehicle = T p_cam, with the vehicle
/// x forward, y left, z up. In MRPT: CPose3D(0, 0, 0, -90 deg, 0, -90 deg).
SE3 T_vehicle_cam_forward();

}  // namespace edgevo
