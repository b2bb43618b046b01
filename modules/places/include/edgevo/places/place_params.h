// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of recognising places.
struct PlaceParams {
  /// Whether places that the run has seen before are looked for.
  bool loops = true;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v) {
    v.boolean(kBasic, "loops", loops,
              "recognise places that the run has seen before, and correct the map by them");
  }
};

}  // namespace edgevo
