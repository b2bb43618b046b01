// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/run_quality/trusted_part.h"

namespace edgevo {
namespace {

Run without(const Run& run, bool doubtful) {
  Run part = run;
  for (KeyframeRecord& k : part.keyframes)
    if (k.is_doubtful == doubtful) k.points.clear(), k.lines.clear();
  return part;
}

}  // namespace

Run trusted_part(const Run& run) { return without(run, true); }

Run doubtful_part(const Run& run) { return without(run, false); }

}  // namespace edgevo
