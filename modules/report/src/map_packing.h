#pragma once
// The map in 3D as the text that assets/map_view.js reads: JSON with base64 of quantised values.
#include <string>
#include <vector>

#include "edgevo/report/map_view.h"

namespace edgevo {

/// At most `most` of the vertices, evenly over the list. Lines are kept or left out in pieces of up to 256
/// vertices: a line is thinned by whole pieces, never by corners.
std::vector<MapVertex> thinned(const std::vector<MapVertex>& vertices, size_t most);

/// JSON object of base64 texts; numbers are little endian.
/// - unit: plain text.
/// - block: number of vertices that share a box; boxes: float32 x 6 a block, lowest corner and step.
/// - positions: uint16 x 3 a vertex, corner + value * step. An outlier costs precision in its own block only.
/// - sigma: uint8 a vertex, 0 unknown, else sigma_low * (sigma_high / sigma_low)^((value - 1) / 254).
/// - gray: uint8 a vertex.
/// - joined: a bit a vertex, lowest first; empty if none is.
/// - hosts: int32 pairs, so many vertices of that keyframe.
/// - path, truth: float32 x 3 a frame, NaN where there is none; seconds: float32 a frame.
/// - keyframes: float32 x 7 each, position and quaternion x y z w of T_map_cam; frames: int32 each, in the
///   source.
/// - ramp: uint8 x 3, colours from low to high.
std::string packed(const MapView& view);

}  // namespace edgevo
