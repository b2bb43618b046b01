// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One function for each consistency test (confidence/motion_confidence.h): from a measurement with its
// standard deviation to a number that grows with what speaks against the motion. Where the tolerance is known
// it is the logarithm of the odds that the motion lies beyond it, else the logarithm of a size. NaN: not
// known, which speaks neither for nor against.
#include "edgevo/confidence/status_params.h"
#include "edgevo/core/frame_evidence.h"

namespace edgevo {

/// Probability that an error of this mean and standard deviation, normally distributed, exceeds the tolerance
/// either way, 0 to 1; NaN if one of them is.
double probability_beyond(double mean, double sigma, double tolerance);
/// No measurement is surer than this: a probability, and a size over its tolerance. It shall not outweigh the
/// others: that nothing was adjusted does not prove a map.
constexpr double kMostCertain = 0.01;
/// Natural logarithm of the odds.
double log_odds(double probability);

/// Largest error of a right translation over ten frames, median depths: a quarter of its length, or 2 % of
/// the depth. `length_depths`: length of the motion, median depths.
double translation_tolerance(double length_depths);
/// Log odds of a wrong motion over ten frames by corners: of a translation beyond the tolerance, or a
/// rotation beyond 3 degrees. Corners that are few, far or without a unit have a large standard deviation.
double evidence_of_corners(const CornerEvidence& c, double length_depths);
/// By how much adjustments of keyframes moved the camera within the ten frames (`moved_depths`, median
/// depths): natural logarithm of tolerances.
double evidence_of_map(double moved_depths, double length_depths);
/// Log odds of a wrong translation that the turn over ten frames hides (2 % of the depth and a quarter of the
/// length): rows read out one after another, a residual distortion and wrong depths all make a turn look like
/// a translation in proportion to it, for edges and for corners alike. `error_per_rad`: its standard
/// deviation, median depths per radian.
double evidence_of_turn(double turn_rad, double length_depths, double error_per_rad);
/// Natural logarithm of a step over the usual one; negative for shorter steps. Steps up to kSmallStep do
/// not count.
double change_of_step(double step, double usual, double median_depth);
/// Probability that a turn over ten frames, `turn_deg`, is wrong by a wrong focal length (3 degrees): a turn
/// is the way of the image over the focal length. `focal_error`: true focal length over the camera's, less 1.
/// A vague estimate speaks against few files: most are right.
double probability_of_wrong_focal_length(double focal_error, double sigma, double turn_deg);

/// Probability that a translation over ten frames of `length_depths` is wrong, since a lens that zooms has
/// feigned one of `feigned_depths`, with that standard deviation, median depths. A vague estimate speaks
/// against few lenses: most do not zoom. NaN: 0.
double probability_of_wrong_zoom(double feigned_depths, double sigma, double length_depths);

}  // namespace edgevo
