// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Written by `edgevo_fit_trust RUNS.txt modules/odometry/src/trust_table.h REPORT.md`
// (share/training/README.md) from 68 runs of 8 cameras; no_witness and turn from 28 later ones, with the
// other weights and the calibration as they were (share/lab/archive/2026-11-27_turns_and_trust.md).
#include <array>

#include "edgevo/odometry/trust.h"

namespace edgevo::trust_table {

/// What a doubt adds to the sum, per unit of the doubt: at least 0, since all of them speak against the
/// motion. 0: the other doubts say as much.
struct Term {
  Doubt doubt;
  const char* name;
  const char* unit;
  double weight;
};
constexpr std::array<Term, kDoubts> kTerms{{
    {Doubt::kMotion, "motion", "share of length / 0.25 and median depths / 0.02, or degrees / 3", 1.5698},
    {Doubt::kCornerScale, "corner_scale", "log ratio / log 1.25", 0.0946},
    {Doubt::kCornerAgreement, "corner_agreement", "2 x share of the corners", 0.7048},
    {Doubt::kNoWitness, "no_witness", "1: the motion cannot be checked", 0.5000},
    {Doubt::kTurn, "turn", "median depths / 0.02 and share of length / 0.25", 0.5000},
    {Doubt::kStep, "step", "log ratio to the usual", 2.3291},
    {Doubt::kWeakDirection, "weak_direction", "log10 of sigma / 0.001 (median depths; rad)", 0.2352},
    {Doubt::kAdjustment, "adjustment", "log of squared sigmas", 0.4391},
    {Doubt::kStarvation, "starvation", "shares", 2.5173},
    {Doubt::kImage, "image", "blur / 0.1 + saturated share / 0.3, above the usual", 1.4165},
}};

/// Probability of a right motion at a sum of weighted doubts; linear in between, constant outside.
constexpr std::array<TrustKnot, 20> kKnots{{
    {0.0783, 0.9950}, {0.3175, 0.9950}, {0.5385, 0.9950}, {0.7231, 0.9914}, {0.9388, 0.9850},
    {1.1749, 0.9796}, {1.4334, 0.9792}, {1.7353, 0.9672}, {2.1242, 0.9192}, {2.7294, 0.8650},
    {3.4596, 0.6752}, {4.2718, 0.5637}, {4.9230, 0.4447}, {5.1430, 0.3452}, {5.3245, 0.3424},
    {5.4488, 0.2808}, {5.6018, 0.2441}, {6.6432, 0.1974}, {8.8452, 0.1264}, {10.7530, 0.1126},
}};

/// Value of p_right below which a frame is doubtful.
constexpr double kDoubtfulBelow = 0.2469;

}  // namespace edgevo::trust_table
