// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "edgevo/core/params.h"
#include "edgevo/core/records.h"

namespace edgevo {

/// Parameters of the self-calibration.
struct SelfCalibrationParams {
  /// "none", "k1", "readout", "focal" or "all".
  std::string refine = "all";
  /// Keyframes.
  int min_keyframes = 30;
  /// Standard deviations.
  double significance = kImprobable;
  /// Seconds.
  double readout_s = 0;
  /// Apply half more of a change of the read-out time: matches in distorted rows bias it towards zero.
  bool over_relax_readout = true;

  /// Whether rows may have times of their own.
  bool knows_rolling() const { return readout_s != 0 || refines_readout(); }
  /// Whether k1 is estimated.
  bool refines_k1() const { return refine == "k1" || refine == "all"; }
  /// Whether the read-out time is estimated.
  bool refines_readout() const { return refine == "readout" || refine == "all"; }
  /// Whether the focal length is corrected.
  bool refines_focal_length() const { return refine == "focal" || refine == "all"; }

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
