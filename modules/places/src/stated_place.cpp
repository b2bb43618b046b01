// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/places/stated_place.h"

#include <Eigen/Cholesky>

namespace edgevo {
namespace {

Matrix7d moved(const Sim3& T, const Matrix7d& covariance) {
  const Matrix7d A = T.adjoint();
  return A * covariance * A.transpose();
}

Matrix7d symmetric(const Matrix7d& m) { return 0.5 * (m + m.transpose()); }

}  // namespace

double squared_distance(const Sim3& measured, const Sim3& expected, const Matrix7d& covariance) {
  const Vector7d off = (measured * expected.inverse()).log();
  return off.dot(covariance.ldlt().solve(off));
}

// T_place_query of one, as the other has it.
bool agree(const StatedPlace& a, const StatedPlace& b, const PlaceStore& places, const PlaceStore& queries) {
  if (!places.is_one_unit(a.place, b.place) || !queries.is_one_unit(a.query, b.query)) return false;
  const Sim3 to_place{1, places.T_a_b(a.place, b.place)}, from_query{1, queries.T_a_b(b.query, a.query)};
  const Sim3 to_query_by_b = to_place * b.T_place_query;
  const Matrix7d covariance = a.covariance + places.path_covariance(a.place, b.place) +
                              moved(to_place, b.covariance) +
                              moved(to_query_by_b, queries.path_covariance(b.query, a.query));
  return squared_distance(a.T_place_query, to_query_by_b * from_query, covariance) < kThreeSigmas;
}

Constraint constraint_of(const StatedPlace& stated, const PlaceStore& places, const PlaceStore& queries) {
  Constraint c;
  c.kind = ConstraintKind::kPlace;
  c.from = NodeId::keyframe(places.keyframes()[stated.place].id);
  c.to = NodeId::keyframe(queries.keyframes()[stated.query].id);
  c.T_from_to = stated.T_place_query;
  c.covariance = symmetric(stated.covariance);
  return c;
}

Constraint constraint_in_world(const StatedPlace& stated, const PlaceStore& places,
                               const PlaceStore& queries) {
  Constraint c = constraint_of(stated, places, queries);
  const Sim3 T_world_place{1, places.keyframes()[stated.place].record->T_world_cam};
  c.from = NodeId::world();
  c.T_from_to = T_world_place * c.T_from_to;
  c.covariance = symmetric(moved(T_world_place, c.covariance));
  return c;
}

}  // namespace edgevo
