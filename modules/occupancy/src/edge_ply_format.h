// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Layout of edges.ply, common to writer and reader.
#include <cstddef>

namespace edgevo::ply {

/// First words of the header's comments: `keyframe FRAME SEGMENT tx ty tz qx qy qz qw` (pose in the map; the
/// order is that of the vertices' `keyframe`), `mount tx ty tz qx qy qz qw` (T_vehicle_cam), `scale SOURCE
/// METRES_PER_UNIT SIGMA`, `pinhole fx fy cx cy width height` (in which the points were seen).
constexpr const char *kKeyframe = "keyframe", *kMount = "mount", *kScale = "scale", *kPinhole = "pinhole";

/// Byte offsets and size of a vertex: float x y z, uchar red green blue, float idepth idepth_sigma, int
/// keyframe observations line, uchar gray_dark gray_bright line_kind views.
constexpr size_t kIdepthOffset = 15, kKeyframeOffset = 23, kLineOffset = 31, kSidesOffset = 35,
                 kVertexBytes = 39;

/// Size of an edge, bytes: int vertex1 vertex2.
constexpr size_t kEdgeBytes = 8;

/// Bits of line_kind.
constexpr int kStraight = 1, kOutline = 2, kOnPlane = 4;

}  // namespace edgevo::ply
