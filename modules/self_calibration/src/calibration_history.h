#pragma once
// The mathematics of a self-calibration: all keyframes so far as one problem, and what becomes of them when the camera is corrected.
#include <vector>

#include "camera_problem.h"
#include "edgevo/mapping/keyframe.h"
#include "edgevo/mapping/map_revision.h"

namespace edgevo {

/// Keyframes as one problem in the camera file's images.
struct CalibrationHistory {
  ba::CameraProblem problem;
  std::vector<std::vector<int>> point_index;  ///< [keyframe][point] -> problem point, -1: none
};

/// `now`: what the keyframes' images are corrected for.
CalibrationHistory make_history(const Pinhole& pinhole, const ImageCorrection& now, const std::vector<const Keyframe*>& keyframes);

/// The solution of an estimate on `then` for the keyframes and points of `now`, which begins with those of `then`. A keyframe that
/// came later keeps its motion against the newest known one, in the solution's unit there, and so does a point.
BaProblem carry_over(const CalibrationHistory& then, const ba::CameraEstimate& estimate, const CalibrationHistory& now);

/// The solution of `e`, anchored at the newest keyframe, as what became of each keyframe; the first `remembered` ones are no longer in
/// the window.
MapRevision make_revision(const Pinhole& pinhole, const ImageCorrection& before, const std::vector<const Keyframe*>& keyframes, size_t remembered,
                          const CalibrationHistory& history, const BaOptions& options, ba::CameraEstimate* e);

/// `history`: the remembered keyframes, the first ones of the revision.
void apply_to_history(const Pinhole& pinhole, const MapRevision& revision, std::vector<Keyframe>* history);

}  // namespace edgevo
