// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Written by `edgevo_fit_trust RUNS.txt modules/confidence/src/trust_table.h REPORT.md`
// (share/training/README.md) from 121 runs of 10 cameras: not to be edited.
#include <array>

#include "edgevo/confidence/motion_confidence.h"

namespace edgevo::trust_table {

/// What a test adds to the log odds of a wrong motion: weight (value - usual). The weight is at least 0,
/// since all of them speak against the motion; `usual` is the mean of right motions.
struct Term {
  ConsistencyTest doubt;
  const char* name;
  const char* unit;
  double weight, usual;
};
constexpr std::array<Term, kConsistencyTests> kTerms{{
    {ConsistencyTest::kRotation, "rotation", "log odds", 0.1614, -6.5232},
    {ConsistencyTest::kTurn, "turn", "log odds", 0.4200, -6.5113},
    {ConsistencyTest::kUnit, "unit", "log ratio", 2.7383, 0.0164},
    {ConsistencyTest::kStep, "step", "log ratio", 1.4528, 0.1495},
    {ConsistencyTest::kResidual, "residual", "log of pixels", 3.0355, -0.3387},
    {ConsistencyTest::kInformation, "information", "decades", 4.3451, -3.1670},
    {ConsistencyTest::kAdjustment, "adjustment", "log of squared sigmas", 0.2905, 0.1815},
}};
/// Log odds of a wrong motion where all is as usual.
constexpr double kBias = -5.1919;

/// Value of p_right below which a frame is doubtful.
constexpr double kDoubtfulBelow = 0.4966;

}  // namespace edgevo::trust_table
