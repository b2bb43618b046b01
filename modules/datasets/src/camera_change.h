// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Cameras of images that were scaled, turned or cut. The lens stays as it is.
#include "edgevo/core/camera.h"

namespace edgevo {

/// A camera for images scaled to width x height. Pixel centres are whole numbers: the border is at -0.5.
Camera scaled_camera(const Camera& camera, int width, int height);
/// A camera for images turned clockwise by `quarter_turns` times 90 degrees.
Camera turned_camera(const Camera& camera, int quarter_turns);
/// A camera for images of width x height cut out of its own at the pixel (x, y).
Camera cut_camera(const Camera& camera, double x, double y, int width, int height);

}  // namespace edgevo
