// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Constraints between the maps of epochs, split into what they say of the units and of the places.
#include <optional>

#include "edgevo/map/map_graph.h"
#include "stated_poses.h"

namespace edgevo {

/// Squared Mahalanobis distance from which what shows a place shows one that looks alike: seven sigmas, as
/// right ones are off by more than they know. By its order, as if one of five were mistaken and 30 times as
/// uncertain then.
inline constexpr double kMistakenFrom = 47;
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
/// first node are `scale_from` times as long. Where it may be mistaken, the second node is anywhere within
/// `mistaken` then, in the unit of the first.
Constraint in_world_unit(const Constraint& c, double scale_from, const std::optional<UnknownPose>& mistaken);
/// How a constraint fails that is mistaken: it says nothing within `unknown`. A covariance that is merely
/// larger would still pull at what lies far beyond it. It fails from kMistakenFrom on.
Constraint::Failure mistaken(const Matrix7d& covariance, const UnknownPose& unknown);
/// A constraint whose scale may fail: an exact one is uncertain by a millionth.
Constraint with_uncertain_scale(Constraint constraint);
/// Whether a constraint measures the unit.
bool measures_unit(const Constraint& c);
/// Whether it measures all of the place and the direction.
bool measures_place(const Constraint& c);
/// What a constraint says of the unit alone.
Constraint of_scale_alone(const Constraint& c);

}  // namespace edgevo
