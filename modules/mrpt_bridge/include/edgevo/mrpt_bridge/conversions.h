#pragma once
// Our values as MRPT's and back, without loss.
//
// Poses keep their meaning: SE3 T_a_b and CPose3D both map coordinates from b to a. Times are integers of the
// same tick (100 ns) and differ only in their epoch, so they pass through unchanged; MRPT's own fromDouble
// would round to 0.24 us. Pixel convention and plumb-bob coefficients are the same on both sides (OpenCV's).
// Cost: nothing but the copy of the pixels. Threads: pure functions.
#include <mrpt/core/Clock.h>
#include <mrpt/img/CImage.h>
#include <mrpt/img/TCamera.h>
#include <mrpt/poses/CPose3D.h>

#include <string>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/se3.h"
#include "edgevo/core/timestamp.h"

namespace edgevo {

mrpt::poses::CPose3D to_mrpt(const SE3& T_a_b);  ///< The same motion.
SE3 from_mrpt(const mrpt::poses::CPose3D& T_a_b);  ///< The same motion.

/// Exact for every tick; MRPT counts from 1601 (its "no time" is tick 0 of that epoch).
mrpt::Clock::time_point to_mrpt(Timestamp t);
Timestamp from_mrpt(mrpt::Clock::time_point t);  ///< Exact for every tick.

/// Always with the plumb-bob model, zeros included.
mrpt::img::TCamera to_mrpt(const Camera& camera);
/// `where` (file and observation) opens the message of the InputError for a lens model other than none and
/// plumb-bob with k1 k2 p1 p2 k3, and for values that Camera::check refuses.
Camera from_mrpt(const mrpt::img::TCamera& camera, const std::string& where);

/// A deep copy as an 8-bit gray CImage.
mrpt::img::CImage to_mrpt(const GrayImage& image);
/// Pixels of an image held in memory (not of one stored externally: see rawlog_source.h). Colour becomes gray
/// by OpenCV's weights, exactly as read_gray_image() does. Throws InputError for an empty image or one deeper
/// than 8 bits.
GrayImage from_mrpt(const mrpt::img::CImage& image, const std::string& where);

/// The mount of a camera that looks straight ahead from the vehicle's origin: p_vehicle = T p_cam, with the
/// vehicle x forward, y left, z up. MRPT writes it CPose3D(0, 0, 0, -90 deg, 0, -90 deg).
SE3 T_vehicle_cam_forward();

}  // namespace edgevo
