// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The data of the map in 3D as text for assets/map_data.js: JSON with base64 of quantised values.
#include <string>
#include <vector>

#include "edgevo/report/map_view.h"

namespace edgevo {

/// At most `most` of the vertices, taken evenly from the list. Lines are kept or dropped in whole pieces of
/// up to 256 vertices, so that their shape is preserved.
std::vector<MapVertex> thinned(const std::vector<MapVertex>& vertices, size_t most);

/// The view as a JSON object of base64 strings; numbers are little endian.
/// - unit: plain text.
/// - block: number of vertices with a common box; boxes: float32 x 6 a block, lowest corner and step.
/// - positions: uint16 x 3 a vertex, corner + value * step. An outlier costs precision in its own block only.
/// - sigma: uint8 a vertex, 0 unknown, else sigma_low * (sigma_high / sigma_low)^((value - 1) / 254).
/// - gray: uint8 a vertex.
/// - joined: one bit a vertex, lowest bit first; empty if no vertex is joined.
/// - hosts: int32 pairs, number of vertices and index of their keyframe.
/// - path, truth: float32 x 3 a frame, NaN without a position; seconds: float32 a frame.
/// - keyframes: float32 x 7 each, position and quaternion x y z w of T_map_cam; frames: int32 each, in the
///   source.
/// - ramp: uint8 x 3, colours from low to high.
std::string packed(const MapView& view);

}  // namespace edgevo
