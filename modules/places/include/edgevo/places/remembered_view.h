// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is kept of a keyframe's image so that its place is recognised later: corners with descriptors, edges,
// and a signature of the whole view. Nothing here depends on the map.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// 256 bits: an upright ORB descriptor.
using CornerDescriptor = std::array<uint8_t, 32>;

/// Corners with upright ORB descriptors: a vehicle or a robot sees a place with the same side up.
struct ViewCorners {
  /// Where they are, pixels of the rectified image.
  std::vector<Eigen::Vector2f> px;
  /// One for each.
  std::vector<CornerDescriptor> descriptors;
};

/// The edges of a level in 5 bytes a pixel: positions to 1/16 pixel, normals to 1.4 degrees.
struct PackedEdges {
  /// Pinhole of the level.
  Pinhole pinhole;
  /// Positions in sixteenths of a pixel.
  std::vector<std::array<uint16_t, 2>> at;
  /// Directions of the normals, 256 to the full circle.
  std::vector<uint8_t> normal;
  /// Index of the first pixel of each edge.
  std::vector<int32_t> begins;
};

/// Which directions the edges of each cell of the view have: a bit is set where a direction is commoner in
/// the cell than in the cells of the view on average.
struct ViewSignature {
  /// Cells across and down, and directions of half a turn.
  static constexpr int kColumns = 12, kRows = 6, kDirections = 8;
  /// The bits, cell by cell.
  std::array<uint64_t, kColumns * kRows * kDirections / 64> bits{};
};
/// Number of bits that differ.
int distance(const ViewSignature& a, const ViewSignature& b);

/// The light in a view.
struct ViewLight {
  /// Mean and standard deviation of the gray levels.
  float mean = 0, contrast = 0;
};

/// A view as it is remembered. About 50 kB at 1241x376.
struct RememberedView {
  /// Its corners.
  ViewCorners corners;
  /// Its edges, of the level below the finest: a place seen again is seen from elsewhere, to less than a
  /// pixel.
  PackedEdges edges;
  /// Its signature.
  ViewSignature signature;
  /// Its light.
  ViewLight light = {};
};

/// Remembers a view. Without corners and edges on parts that are fixed to the camera. Cost: some 10 ms at
/// 1241x376.
RememberedView remember_view(const FramePyramid& pyramid);

/// A pyramid of one level with the edges and their nearest-neighbour field, without images: enough to align a
/// cloud's edges with it. Cost: about 1 ms.
FramePyramid unpack(const PackedEdges& packed);

}  // namespace edgevo
