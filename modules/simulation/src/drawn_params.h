// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Scenes that nobody chose: their seed draws camera, motion, light, length and path, besides the world.
//
// They test the program on what it was not tuned to. So their ranges are wide, and a seed that looks hard is
// kept. The file of such a scene gives the size of its images and the kind of its world.
#include <cstdint>
#include <string>

#include "scene_params.h"

namespace edgevo {

/// Whether scenes with this kind of world are drawn from their seed.
bool is_drawn(const std::string& kind);

/// Replaces all parameters but the size of the image, the rate and the kind of world by those that the seed
/// draws. `where` opens the error messages.
void draw_params(uint64_t seed, const std::string& where, SceneParams* params);

}  // namespace edgevo
