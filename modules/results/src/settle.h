#pragma once
#include "edgevo/results/run_journal.h"

namespace edgevo {

/// Gives the frames of a run that was cut off their final poses: between two keyframes of a segment they move
/// as those have moved since the frames came, lengths included. Where no keyframe is near, the live pose
/// stands.
void settle_frames(CutOffRun* cut_off);

}  // namespace edgevo
