// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How many places are tried for a view, and how many views in a row must agree: of keyframes and of single
// images.
#include <cstddef>

#include "edgevo/map/located_pose.h"

namespace edgevo {

/// Places that are tried for each view.
inline constexpr size_t kCandidates = 3;
/// A place is believed if so many of the last queries agree.
inline constexpr size_t kAgreeing = 3, kRecent = kImagesToLocate;

}  // namespace edgevo
