// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The places of the keyframes themselves, where a constraint relates two keyframes of one epoch: a place seen
// again. The epochs are placed; each keyframe then is a node with a unit of its own, tied to the next one by
// their relative pose (NeighbourPose) and a unit that drifts. What the constraint contradicts is spread along
// the path between its ends. Where keyframes are found in a map that was kept, all come into its frame and
// unit.
#include <map>
#include <vector>

#include "edgevo/map/epochs.h"

namespace edgevo {

/// Whether a constraint relates two known keyframes in their place, by more than the features that link the
/// ends of a doubt, or one to a map that was kept.
bool relates_keyframes(const Constraint& constraint, const RunSoFar& run);

/// Places the keyframes of the run anew: PlacedEpochs::own of each, and the map of the last epoch as its
/// newest keyframe. `placed`: the epochs, and what is unused; a constraint that now fails is added to these.
/// `keyframes`: all that are known, ascending id. Cost: some 0.1 ms a keyframe.
void place_keyframes(const std::map<int, Constraint>& constraints,
                     const std::vector<KeyframeInMap>& keyframes, const RunSoFar& run, PlacedEpochs* placed);

}  // namespace edgevo
