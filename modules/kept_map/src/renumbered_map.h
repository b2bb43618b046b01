// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Maps one after the other in one file: keyframes, segments and epochs get numbers of their own.
#include <map>

#include "edgevo/kept_map/kept_map.h"

namespace edgevo {

/// New ids of keyframes by their old ones.
using Numbers = std::map<int, int>;

/// Appends the keyframes and constraints of a map, numbered after what is there.
Numbers append(const KeptMap& map, KeptMap* to);
/// The constraint with the new ids of its ends, which must be known.
Constraint renumbered(Constraint c, const Numbers& of_from, const Numbers& of_to);
/// Gives a constraint the unit to which the maps around its keyframes were moved, by their ids; false if one
/// is not known.
bool in_unit_of(const std::map<int, Sim3>& T_of_keyframe, Constraint* c);

}  // namespace edgevo
