// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the lines of edges take from tracking: how a frame is aligned, and whether its pose counts.
#include "edgevo/alignment/alignment_params.h"
#include "edgevo/confidence/status_params.h"

namespace edgevo {

/// How tracking aligns a frame, and when the image supports the pose: that of a view between
/// keyframes, too.
struct ViewAlignment {
  /// Costs.
  AlignmentParams alignment;
  /// Thresholds.
  StatusParams status;
};

}  // namespace edgevo
