// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Conversion of images, cameras and motions between edgevo and ViSP.
//
// Conventions agree: camera x right, y down, z forward; pixel (0,0) is the centre of the top-left pixel; a
// transformation named aMb in ViSP is T_a_b here (p_a = aMb p_b). ViSP's servo loops use cMw, the inverse of
// edgevo's T_world_cam. Lengths keep their unit: a monocular T_world_cam is metric only if a scale source was
// set.
//
// Distributed under the GPL when linked, as ViSP is (see LICENSE).
#include <visp3/core/vpCameraParameters.h>
#include <visp3/core/vpHomogeneousMatrix.h>
#include <visp3/core/vpImage.h>
#include <visp3/core/vpRGBa.h>

#include "edgevo/core/camera.h"
#include "edgevo/core/image.h"
#include "edgevo/core/se3.h"

namespace edgevo {

/// A ViSP image that shares the pixels of `image` without a copy. `image` must outlive it and keep its size.
/// A copy of the result owns its pixels, as copies of a vpImage do. Throws InputError unless it has width *
/// height pixels.
vpImage<unsigned char> share_with_visp(GrayImage& image);

/// A ViSP image with a copy of the pixels; rows of the view may have a stride.
vpImage<unsigned char> to_visp(const ImageView<uint8_t>& view);

/// A view of the pixels of a ViSP image, without a copy; valid while that image lives and keeps its size.
ImageView<uint8_t> view_of(const vpImage<unsigned char>& image);

/// A copy of a ViSP image.
GrayImage to_gray_image(const vpImage<unsigned char>& image);
/// The gray values of a colour image (with ViSP's weights), written straight into the result.
GrayImage to_gray_image(const vpImage<vpRGBa>& image);

/// ViSP's camera for undistorted images: px = fx, py = fy, u0 = cx, v0 = cy. ViSP keeps no image size.
vpCameraParameters to_visp(const Pinhole& pinhole);

/// ViSP's camera for raw images. Its single radial coefficient kud equals k1; the inverse coefficient kdu is
/// fitted over the image; a Kannala-Brandt lens stays one. Throws InputError for any other lens: then give
/// ViSP rectified images and to_visp(Pinhole) of Run::pinhole. `where` begins the message.
vpCameraParameters to_visp(const Camera& camera, const std::string& where);

/// edgevo's camera from a ViSP camera, including distortion: kud becomes k1; its inverse kdu is not needed.
Camera to_camera(const vpCameraParameters& camera, int width, int height);

/// The pinhole of a ViSP camera for undistorted images of width x height. Throws InputError if the camera has
/// a distortion model: use to_camera().
Pinhole to_pinhole(const vpCameraParameters& camera, int width, int height);

/// The transformation as ViSP's aMb.
vpHomogeneousMatrix to_visp(const SE3& T_a_b);

/// The transformation from ViSP's aMb. Its rotation is normalised, since that of a vpHomogeneousMatrix may
/// have drifted.
SE3 to_se3(const vpHomogeneousMatrix& aMb);

}  // namespace edgevo
