// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How the views of a bootstrap become the first keyframes of a map.
#include <vector>

#include "edgevo/map/keyframe.h"
#include "edgevo/mapping/bootstrap.h"
#include "edgevo/mapping/depth_filter.h"

namespace edgevo {

/// Search range of the inverse depth at `px` of the first or the last view: around that of the nearest
/// triangulated corner.
IdepthRange range_near(const std::vector<BootstrapCorner>& corners, bool in_last, const Eigen::Vector2d& px);

/// The first view, up to three between, and the last view. `views` has two or more.
std::vector<const BootstrapView*> choose_keyframe_views(const std::vector<BootstrapView>& views);

}  // namespace edgevo
