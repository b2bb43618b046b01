#pragma once
// Images, cameras and motions between edgevo and ViSP, for programs whose loop is ViSP's.
//
// Conventions agree: camera x right, y down, z forward; pixel (0,0) is the centre of the top-left pixel; a
// transformation named aMb in ViSP is T_a_b here (p_a = aMb p_b). ViSP's servo loops want cMw, which is the
// inverse of the T_world_cam that edgevo keeps. Lengths keep their unit: a monocular T_world_cam is metric
// only if a scale source was set.
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

/// A ViSP image that shares the pixels of `image` (no copy; both see what either writes). `image` must stay
/// alive and keep its size meanwhile. A copy of the result owns its own pixels, as copies of a vpImage do.
vpImage<unsigned char> share_with_visp(GrayImage& image);

/// A ViSP image with a copy of the pixels; rows of the view may have a stride.
vpImage<unsigned char> to_visp(const ImageView<uint8_t>& view);

/// A view of the pixels of a ViSP image (no copy); valid while that lives and keeps its size.
ImageView<uint8_t> view_of(const vpImage<unsigned char>& image);

/// A copy of a ViSP image.
GrayImage to_gray_image(const vpImage<unsigned char>& image);
/// The gray values of a colour image (ViSP's weights), straight into the result: no other copy is made.
GrayImage to_gray_image(const vpImage<vpRGBa>& image);

/// ViSP's camera for undistorted images: px = fx, py = fy, u0 = cx, v0 = cy. ViSP keeps no image size.
vpCameraParameters to_visp(const Pinhole& pinhole);

/// ViSP's camera for the images as they come. Its one radial coefficient kud is our k1, exactly; kdu, for the
/// way back, is fitted over the image. Throws InputError where the lens needs more than k1: then hand ViSP
/// undistorted images and to_visp(Pinhole).
vpCameraParameters to_visp(const Camera& camera, const std::string& where);

/// The camera of a ViSP camera, distortion included: kud becomes k1; kdu is its inverse and is not needed.
/// Throws InputError for Kannala-Brandt's model.
Camera to_camera(const vpCameraParameters& camera, int width, int height);

/// The pinhole of a ViSP camera for undistorted images of width x height. Throws InputError if the camera has
/// a distortion model: to_camera() takes it along.
Pinhole to_pinhole(const vpCameraParameters& camera, int width, int height);

vpHomogeneousMatrix to_visp(const SE3& T_a_b);  ///< The same motion, aMb.

/// The rotation is normalised: a vpHomogeneousMatrix may have drifted from one.
SE3 to_se3(const vpHomogeneousMatrix& aMb);

}  // namespace edgevo
