// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The single effects of relight.h. Each takes its own stream of random numbers by value and restarts it for
// every frame, so that frames do not depend on each other. `share` scales the strength, 1 = as documented.
#include <vector>

#include "edgevo/core/random.h"

namespace edgevo {

/// Gray values that may exceed 0..255 until the sensor clamps them.
struct LitImage {
  int width, height;
  std::vector<float> gray;
};

void drift_gain(Random random, double seconds, double share, LitImage* image);
void jump_exposure(Random random, double seconds, double share, LitImage* image);
void bend_response(Random random, double seconds, double share, LitImage* image);
void vignette(double share, LitImage* image);
void add_glare(Random random, double seconds, double share, LitImage* image);
void bloom_highlights(LitImage* image);
void sweep_shadows(Random random, double seconds, LitImage* image);
void blur_along_motion(Random random, double seconds, LitImage* image);

}  // namespace edgevo
