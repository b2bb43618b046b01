// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What is said of one place that two keyframes show, and whether two such statements can both be true.
#include "edgevo/map/map_graph.h"
#include "edgevo/places/place_store.h"

namespace edgevo {

/// A keyframe of one store recognised as the place of a keyframe of another, or of the same.
struct StatedPlace {
  /// Positions of the keyframes: in the store of the places, and in that of the queries.
  size_t place = 0, query = 0;
  /// From the query's frame and unit to those of the place.
  Sim3 T_place_query;
  /// Covariance of xi in T_place_query <- exp(xi) T_place_query.
  Matrix7d covariance = Matrix7d::Identity();
};

/// Squared Mahalanobis distance of seven directions that is exceeded once in 370 times: three sigmas.
inline constexpr double kThreeSigmas = 21.8;
/// Squared Mahalanobis distance of what was measured from what was expected.
double squared_distance(const Sim3& measured, const Sim3& expected, const Matrix7d& covariance);

/// Whether the way over place and query of one is that of the other, as far as the paths between may be off.
/// Cost: a microsecond for each keyframe between.
bool agree(const StatedPlace& a, const StatedPlace& b, const PlaceStore& places, const PlaceStore& queries);

/// The statement as a constraint between the two keyframes, by their ids.
Constraint constraint_of(const StatedPlace& stated, const PlaceStore& places, const PlaceStore& queries);
/// The same from the world of the places to the query.
Constraint constraint_in_world(const StatedPlace& stated, const PlaceStore& places,
                               const PlaceStore& queries);

}  // namespace edgevo
