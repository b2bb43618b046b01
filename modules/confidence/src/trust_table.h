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
    {ConsistencyTest::kCorners, "corners", "log odds", 0.2593, -4.1703},
    {ConsistencyTest::kTurn, "turn", "log odds", 0.4830, -6.5110},
    {ConsistencyTest::kStep, "step", "log ratio", 1.5438, 0.1498},
    {ConsistencyTest::kResidual, "residual", "log of pixels", 1.3951, -0.3390},
    {ConsistencyTest::kInformation, "information", "decades", 4.1662, -3.1669},
    {ConsistencyTest::kMap, "map", "log of tolerances", 0.9512, -2.2847},
}};
/// Log odds of a wrong motion where all is as usual.
constexpr double kBias = -6.4862;

/// Value of p_right below which a frame is doubtful.
constexpr double kDoubtfulBelow = 0.7108;

}  // namespace edgevo::trust_table
