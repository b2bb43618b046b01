// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/confidence/status_params.h"

namespace edgevo {

void StepGateParams::visit(ParamVisitor& v) {
  v.number(
      kExperimental, "times", times, 1, 1e6,
      "a step of more than so many usual ones is an outlier: between frames no camera speeds up so much");
}

void ConfidenceParams::visit(ParamVisitor& v) {
  {
    const auto g = v.group("step");
    step.visit(v);
  }
  v.number(kExperimental, "turn_error", turn_error, 0, 1,
           "translation that a turn makes, median depths per radian (one standard deviation): of a Kinect's "
           "rolling shutter");
}

}  // namespace edgevo
