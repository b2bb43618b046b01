#include "edgevo/core/records.h"

#include <cstdio>

namespace edgevo {

std::string unit_statement(const Run& run) {
  if (!run.is_metric()) return "arbitrary (scale of a monocular run; set --scale for metres)";
  std::string text = "metre (scale from " + run.scale_source;
  if (run.scale.sigma > 0) {
    char percent[32];
    std::snprintf(percent, sizeof percent, ", +- %.1f %%", 100 * run.scale.sigma);
    text += percent;
  }
  return text + ")";
}

}  // namespace edgevo
