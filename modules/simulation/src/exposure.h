#pragma once
// The time in which an image is taken: rows one after another, each over a while, along the true motion.
#include <vector>

#include "edgevo/simulation/scene.h"

namespace edgevo {

/// Throws InputError: read-out or exposure is negative or longer than the time between two frames, or the
/// scene does not say how the camera moves between its frames.
void check_shutter(const Scene& scene);

/// At how many instants a row must be looked at, so that what moves in the image moves little between two of
/// them; `depth` as SceneRenderer::render_depth gives it. 1 for a camera at rest.
int instants_of_exposure(const Scene& scene, int frame, const std::vector<float>& depth);

/// Brightness of each pixel, the mean over the instants; `rays` as for add_rows_seen. Cost: one rendering for
/// each instant, and with a rolling shutter one look at all surfaces for each row and instant besides.
std::vector<float> expose(const Scene& scene, const std::vector<Eigen::Vector2f>& rays, int frame,
                          int instants);

}  // namespace edgevo
