// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "edgevo/tracking/frame_view.h"

namespace edgevo {

/// The undistorted image with its edges and the map points in view drawn, as JPEG.
std::string edge_image(const FrameView& view);

}  // namespace edgevo
