// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/records.h"

#include <cstdio>

namespace edgevo {

std::string unit_statement(const Run& run) {
  if (!run.is_metric()) return "arbitrary (scale of a monocular run; set --scale for metres)";
  std::string text = "metre (scale from " + run.scale_source;
  char how_certain[64] = "";
  if (run.scale_varies())
    std::snprintf(how_certain, sizeof how_certain, ", UNCERTAIN: the factor ran from %.2f to %.2f",
                  run.scale.lowest, run.scale.highest);
  else if (run.scale.sigma > 0)
    std::snprintf(how_certain, sizeof how_certain, ", +- %.1f %%", 100 * run.scale.sigma);
  text += how_certain;
  return text + ")";
}

}  // namespace edgevo
