// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/features/corner_params.h"

namespace edgevo {

void CornerParams::visit(ParamVisitor& v) {
  v.number(kAdvanced, "max_inlier_share", max_inlier_share, 0, 1,
           "inlier share of a keyframe right after another one (large motion) below which corners give a "
           "motion hypothesis; 0: never");
  v.integer(kAdvanced, "min_agreeing", min_agreeing, 8, 10000, "corners that must agree on one motion");
  v.number(kExperimental, "max_sigma_px", max_sigma_px, 0.2, 1000,
           "standard deviation of a corner along the weaker gradient of its patch above which it counts as "
           "one on an edge, where any motion along it fits, pixels");
}

}  // namespace edgevo
