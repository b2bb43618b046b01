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
    {ConsistencyTest::kCorners, "corners", "log odds", 0.2614, -4.1545},
    {ConsistencyTest::kTurn, "turn", "log odds", 0.4847, -6.5110},
    {ConsistencyTest::kStep, "step", "log ratio", 1.5550, 0.1498},
    {ConsistencyTest::kResidual, "residual", "log of pixels", 1.3930, -0.3390},
    {ConsistencyTest::kInformation, "information", "decades", 4.1716, -3.1669},
    {ConsistencyTest::kMap, "map", "log of tolerances", 0.9167, -2.2610},
}};
/// Log odds of a wrong motion where all is as usual.
constexpr double kBias = -6.4400;

/// Value of p_right below which a frame is doubtful.
constexpr double kDoubtfulBelow = 0.7076;

}  // namespace edgevo::trust_table
