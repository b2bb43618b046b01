#pragma once
// What becomes of the keyframes when the camera is corrected.
#include <vector>

#include "edgevo/mapping/map_revision.h"
#include "history.h"

namespace edgevo {

/// The solution of `e`, anchored at the newest keyframe, as what became of each keyframe; the first
/// `remembered` ones are no longer in the window, and what they say about it becomes its prior.
MapRevision make_revision(const Pinhole& pinhole, const ImageCorrection& before,
                          const std::vector<const Keyframe*>& keyframes, size_t remembered,
                          const CalibrationHistory& history, const BaOptions& options, CameraEstimate* e);

/// `history`: the remembered keyframes, the first ones of the revision.
void apply_to_history(const Pinhole& pinhole, const MapRevision& revision, std::vector<Keyframe>* history);

}  // namespace edgevo
