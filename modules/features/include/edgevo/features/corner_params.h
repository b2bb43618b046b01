// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of motion hypotheses from corners (corner_motion.h).
struct CornerParams {
  /// 0 to 1.
  double max_inlier_share = 0.7;
  /// Corners.
  int min_agreeing = 60;
  /// Pixels.
  double max_sigma_px = 1;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
