// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The rays of an image's sample points.
//
// Surfaces are linear functions of a ray (x, y, 1), which cannot point sideways or back. A lens of a wide
// view therefore looks through the faces of a cube around it: each ray belongs to the face that it meets, and
// is (x, y, 1) in axes of which the third is that face's normal, with x and y between -1 and 1. Pinhole and
// plumb-bob lenses have the front face alone, which then has no end.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "edgevo/core/camera.h"

namespace edgevo {

/// Number of faces: front, right, left, down, up, back.
constexpr int kFaces = 6;
/// Face of a sample that no ray reaches.
constexpr uint8_t kNoFace = 255;

/// Turns rays of a face into the axes of the camera.
const std::array<Eigen::Matrix3d, kFaces>& R_cam_face();

/// The rays of a camera, row by row, sample by sample (sample_offsets()).
struct LensRays {
  /// (x, y) in the axes of the face; empty for a pinhole, whose rays are linear functions of the pixel.
  std::vector<Eigen::Vector2f> xy;
  /// Face of each ray, or kNoFace; empty if all are of the front face.
  std::vector<uint8_t> face;

  /// Whether rays point through several faces.
  bool has_faces() const { return !face.empty(); }
};

/// Cost: an inversion of the lens a pixel; of plumb-bob nine.
LensRays rays_through_lens(const Camera& camera);

}  // namespace edgevo
