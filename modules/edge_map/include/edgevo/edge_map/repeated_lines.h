// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Lines of places that were seen again. Keyframes near each other in time share their lines as they come
// (edge_mapper.h); a place that is passed a second time gets all of them once more. When all poses are final,
// two lines that are one edge are made one, at the mean of their depths, known by the keyframes of both.
#include <vector>

#include "edgevo/core/camera.h"
#include "edgevo/core/records.h"
#include "edgevo/edge_map/edge_map_params.h"

namespace edgevo {

/// Gives the vertices of a keyframe to one long before it in the same segment that has them, too: within 1.5
/// pixels of its line, along it, at the same depth within their sigmas, seen from as near within 1.6 times.
/// Lines are split where vertices go. Where the path has drifted by more between the two, both stay.
/// Keyframes are in order of time, Nothing is done unless lines are fused (params.is_fused()). Cost: 4 s for
/// 360 keyframes with 3000 vertices each, two laps; some microseconds for each pair of keyframes apart.
void merge_repeated_lines(const Pinhole& pinhole, const EdgeMapParams& params,
                          std::vector<KeyframeRecord>* keyframes);

}  // namespace edgevo
