// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The exposure of an image: row by row, each over its exposure time, along the true motion.
#include <vector>

#include "edgevo/simulation/scene.h"
#include "lens_rays.h"

namespace edgevo {

/// Throws InputError: read-out or exposure is negative or longer than the time between two frames, or the
/// scene does not define the camera's motion between its frames.
void check_shutter(const Scene& scene);

/// Number of instants at which a row must be sampled, so that the image moves little between two of them;
/// `depth` as returned by SceneRenderer::render_depth. 1 for a camera at rest.
int instants_of_exposure(const Scene& scene, int frame, const std::vector<float>& depth);

/// Brightness of each pixel, the mean over the instants; `rays` as for add_rows_seen. Cost: one rendering for
/// each instant, and with a rolling shutter one traversal of all surfaces for each row and instant.
std::vector<float> expose(const Scene& scene, const LensRays& rays, int frame, int instants);

/// Which body is seen at each pixel in the middle of the exposure of its row (set_rows_of_bodies()).
std::vector<uint8_t> bodies_in(const Scene& scene, const LensRays& rays, int frame);

}  // namespace edgevo
