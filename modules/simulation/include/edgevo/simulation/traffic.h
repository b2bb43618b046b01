// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Bodies that move along the path of a scene's camera, for views with more than one motion:
//
//   lorry         is caught up with until it is 6 m ahead, followed, and pulls away; again every 26 s
//   overtaking    cars come from behind on the left and drive away ahead
//   oncoming      cars come towards the camera on its left, every 3.5 s
//   crossing      cars cross ahead wherever the path turns off
//   bus           the camera stands for 8 s before the first such place while a bus and a car cross
//   stop-and-go   the camera and a lorry 7 m ahead of it stop every 8 s for 2.5 s
//   people        walk ahead of the camera and towards it
//
// Bodies are textured boxes, prisms and cut-outs that stand on the ground z = 0; what hides what is exact.
// They do not see one another: several kinds in one scene may pass through each other.
#include <string>
#include <vector>

#include "edgevo/simulation/scene.h"

namespace edgevo {

/// The kinds of traffic above, in that order.
const std::vector<std::string>& traffic_kinds();

/// Adds traffic of one kind to `scene`. Where the camera stands, the scene becomes longer. Everything random
/// follows from the seed of the scene. Throws InputError: unknown kind, a path shorter than 10 m, cars that
/// would cross a path without turns.
void add_traffic(const std::string& kind, Scene* scene);

}  // namespace edgevo
