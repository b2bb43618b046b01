// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How keyframes change when the camera is corrected.
#include <vector>

#include "edgevo/mapping/map_revision.h"
#include "history.h"

namespace edgevo {

/// The solution of `e`, anchored at the newest keyframe, as a revision of each keyframe. The first
/// `remembered` keyframes are no longer in the window; their information on the window becomes its prior.
MapRevision make_revision(const Pinhole& pinhole, const ImageCorrection& before,
                          const std::vector<const Keyframe*>& keyframes, size_t remembered,
                          const CalibrationHistory& history, const BaOptions& options, CameraEstimate* e);

/// Applies a revision to the remembered keyframes, which are the first ones of the revision.
void apply_to_history(const Pinhole& pinhole, const MapRevision& revision, std::vector<Keyframe>* history);

}  // namespace edgevo
