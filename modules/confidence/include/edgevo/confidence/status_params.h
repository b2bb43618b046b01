// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/core/params.h"

namespace edgevo {

/// Thresholds of the tracking status; keys of the group `alignment`. Read in src/frame_status.cpp only.
struct StatusParams {
  /// Share of the weighted points (alignment/pose_evidence.h).
  double degraded_share = 0.4;
  /// Share of the weighted points.
  double lost_share = 0.15;
  /// Points.
  int min_visible = 60;
  /// Share of the median depth; radians.
  double weak_sigma = 0.01;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
