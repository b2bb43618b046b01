// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Written by `edgevo_fit_trust RUNS.txt modules/confidence/src/trust_table.h REPORT.md`
// (share/training/README.md) from 54 runs of 8 cameras: not to be edited.
#include <array>

#include "edgevo/confidence/motion_confidence.h"

namespace edgevo::trust_table {

/// What a doubt adds to the sum, per unit of the doubt: at least 0, since all of them speak against the
/// motion. 0: the other doubts say as much.
struct Term {
  ConsistencyTest doubt;
  const char* name;
  const char* unit;
  double weight;
};
constexpr std::array<Term, kConsistencyTests> kTerms{{
    {ConsistencyTest::kMotion, "motion", "share of length / 0.25 and median depths / 0.02, or degrees / 3",
     0.9458},
    {ConsistencyTest::kFocalLength, "focal_length", "degrees / 3", 2.9905},
    {ConsistencyTest::kCornerAgreement, "corner_agreement", "2 x share of the corners", 0.5429},
    {ConsistencyTest::kNoCrossCheck, "no_witness", "1: the motion cannot be checked", 0.0000},
    {ConsistencyTest::kTurn, "turn", "median depths / 0.02 and share of length / 0.25", 0.7363},
    {ConsistencyTest::kStep, "step", "log ratio to the usual", 2.1482},
    {ConsistencyTest::kResidual, "residual", "log of pixels / 0.6", 4.2032},
    {ConsistencyTest::kAdjustment, "adjustment", "log of squared sigmas", 1.8206},
    {ConsistencyTest::kStarvation, "starvation", "shares", 0.7443},
    {ConsistencyTest::kImage, "image", "blur / 0.1 + saturated share / 0.3, above the usual", 0.0000},
}};

/// Probability of a right motion at a sum of weighted doubts; linear in between, constant outside.
constexpr std::array<CalibrationKnot, 18> kKnots{{
    {0.4034, 0.9950},
    {1.3097, 0.9950},
    {1.8517, 0.9947},
    {2.2933, 0.9901},
    {2.7219, 0.9828},
    {3.1329, 0.9762},
    {3.6306, 0.9109},
    {4.3368, 0.8398},
    {5.4464, 0.6199},
    {6.4023, 0.4252},
    {6.7127, 0.3365},
    {7.0153, 0.2580},
    {7.4632, 0.1798},
    {8.1309, 0.1724},
    {8.7067, 0.1334},
    {9.1843, 0.1139},
    {11.1782, 0.1075},
    {16.5077, 0.0050},
}};

/// Value of p_right below which a frame is doubtful.
constexpr double kDoubtfulBelow = 0.4467;

}  // namespace edgevo::trust_table
