#pragma once
// Walls without texture: flat patches that straight lines of edges frame.
#include <vector>

#include "wall_line.h"
#include "wall_patch.h"

namespace edgevo {

/// Which lines frame a patch; lengths in the unit of the map.
struct PatchRules {
  double thickness = 0;   ///< corners within this distance of a plane lie in it
  double least_side = 0;  ///< nothing to fill between lines that are nearer
  double most_side = 0;   ///< lines that are farther apart say nothing of what is between
  double frame_gap = 0;   ///< from the side of a patch to the line that frames it, at most
  int min_keyframes = 3;  ///< that saw both lines
};

/// Patches between two parallel lines, at least one of whose open sides a third line closes: two posts are no
/// wall. `lines` in the order of their first keyframes. Cost: pairs of lines that the same keyframes saw.
std::vector<WallPatch> wall_patches(const std::vector<WallLine>& lines, const PatchRules& rules);

}  // namespace edgevo
