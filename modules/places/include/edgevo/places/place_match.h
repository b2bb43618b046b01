// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Whether two remembered views show one place, and how the cameras lay: the proof. What nominates a pair of
// views (place_index.h) may be wrong; what is proved here becomes a constraint of the map.
//
// Corners: a pose by three of them (P3P) that so many others agree with as hardly happens by chance. Edges:
// from there the edges of each view are aligned with those of the other, in both directions, and must agree
// better than the same edges displaced; together with the corners as hardly happens by chance. Both count
// false alarms a contrario (Moisan and Stival, "A probabilistic criterion to detect rigid point matches
// between two images", IJCV 2004): no threshold depends on the scene, its light or the size of its images.
#include <optional>
#include <vector>

#include "edgevo/alignment/reference_cloud.h"
#include "edgevo/core/sim3.h"
#include "edgevo/places/remembered_view.h"

namespace edgevo {

/// A remembered view with the map around it.
struct PlaceView {
  /// The view.
  const RememberedView& view;
  /// Points of the map in its frame, in the unit of its map.
  std::vector<CloudPoint> points;
};

/// What supports one place.
struct PlaceEvidence {
  /// Pairs of corners that look alike, and those that agree with the pose.
  int pairs = 0, agreeing = 0;
  /// Decimal logarithm of the expected number of poses that so many corners agree with by chance.
  double corners_log_alarms = 0;
  /// Share of the edges that agree, in each direction.
  double share[2] = {0, 0};
  /// Share that agrees by chance: of the same edges displaced.
  double chance[2] = {0, 0};
  /// As corners_log_alarms, of the edges; the larger one of the two directions.
  double edges_log_alarms = 0;
};

/// Two views of one place.
struct PlaceMatch {
  /// From the frame and unit of view b to those of view a.
  Sim3 T_a_b;
  /// Covariance of xi in T_a_b <- exp(xi) T_a_b.
  Matrix7d covariance = Matrix7d::Identity();
  /// What it rests on.
  PlaceEvidence evidence;
};

/// A view in a map.
struct LocatedView {
  /// From its camera to that of a view of the map, in the unit of the map.
  SE3 T_a_b;
  /// Covariance of xi in T_b_a <- exp(xi) T_b_a.
  Matrix6d covariance = Matrix6d::Identity();
  /// Median depth of the points around view a, in the unit of the map.
  double median_depth = 1;
  /// What it rests on; of the edges only those of the map in the view.
  PlaceEvidence evidence;
};

/// Where view b was taken from, by what view a of a map shows; nothing if it is not proved. It needs no map
/// of its own, so that half of what match_views() proves is missing. Deterministic. Cost: as match_views().
std::optional<LocatedView> locate_view(const Pinhole& pinhole, const PlaceView& a, const RememberedView& b,
                                       PlaceEvidence* evidence = nullptr);

/// Recognises one place in two views; nothing if it is not proved. `evidence`, if not null, is what was found
/// all the same. Deterministic. Cost: 3 ms for views of different places, 15 ms with proof.
std::optional<PlaceMatch> match_views(const Pinhole& pinhole, const PlaceView& a, const PlaceView& b,
                                      PlaceEvidence* evidence = nullptr);

}  // namespace edgevo
