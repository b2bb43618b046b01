// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Constraints between the maps of epochs, split into what they say of the units and of the places.
#include "edgevo/map/map_graph.h"
#include "stated_poses.h"

namespace edgevo {

/// Probability that what shows a place shows one that looks alike.
inline constexpr double kPlaceMistaken = 0.2;
/// Standard deviations of what nothing is known of: any direction (rad), and a unit that is a factor of e
/// larger or smaller (logarithm).
inline constexpr double kUnknownRotation = 1, kUnknownScale = 1;

/// Of independent errors: standard deviations of each coordinate of the place, of the rotation about each
/// axis, and of the logarithm of the scale. A place is never more certain than rounding.
Matrix7d covariance_of(double position, double rotation, double scale);

/// A constraint between keyframes as one between the maps that they are of, whose units are known: a length
/// in the first over the same length in the second is `scale`. How it may fail is not part of it.
Constraint between_maps(const Constraint& c, const SE3& T_map_from, const SE3& T_map_to, double scale);
/// What a constraint says of the places alone, for nodes with the unit of the world, where lengths of its
/// first node are `scale_from` times as long. It fails with the probability `fails`; then the second node is
/// anywhere within `unknown`, in the unit of the first.
Constraint in_world_unit(const Constraint& c, double scale_from, double fails, const UnknownPose& unknown);
/// A constraint whose scale may fail: an exact one is uncertain by a millionth.
Constraint with_uncertain_scale(Constraint constraint);
/// Whether a constraint measures the unit.
bool measures_unit(const Constraint& c);
/// Whether it measures all of the place and the direction.
bool measures_place(const Constraint& c);
/// What a constraint says of the unit alone.
Constraint of_scale_alone(const Constraint& c);

}  // namespace edgevo
