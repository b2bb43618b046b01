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
    {ConsistencyTest::kCorners, "corners", "log odds", 0.3411, -2.9564},
    {ConsistencyTest::kTurn, "turn", "log odds", 0.7586, -4.4406},
    {ConsistencyTest::kStep, "step", "log ratio", 2.0367, 0.2274},
    {ConsistencyTest::kResidual, "residual", "log of pixels", 1.1939, -0.3385},
    {ConsistencyTest::kInformation, "information", "decades", 3.9285, -3.1668},
    {ConsistencyTest::kMap, "map", "log of tolerances", 0.8664, -2.8839},
}};
/// Log odds of a wrong motion where all is as usual.
constexpr double kBias = -6.8130;

/// Value of p_right below which a frame is doubtful.
constexpr double kDoubtfulBelow = 0.7149;

}  // namespace edgevo::trust_table
