#pragma once
// How the views of a bootstrap become the first keyframes of a map.
#include <vector>

#include "edgevo/mapping/bootstrap.h"
#include "edgevo/mapping/depth_filter.h"
#include "edgevo/mapping/keyframe.h"

namespace edgevo {

/// Search range of the inverse depth at `px` of the first view or the last one: around that of the
/// triangulated corner nearest to it.
IdepthRange range_near(const std::vector<BootstrapCorner>& corners, bool in_last, const Eigen::Vector2d& px);

/// First and last view, and up to three between them. `views` has two or more.
std::vector<const BootstrapView*> choose_keyframe_views(const std::vector<BootstrapView>& views);

}  // namespace edgevo
