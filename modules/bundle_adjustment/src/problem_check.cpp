// SPDX-License-Identifier: BSD-3-Clause
// Checks of a BaProblem: well-formed, finite, anything to solve.
#include <cmath>

#include "edgevo/core/error.h"
#include "packed_problem.h"

namespace edgevo::ba {
namespace {

[[noreturn]] void malformed(const std::string& what, const std::string& remedy) {
  throw InputError("bundle adjustment", what, remedy);
}

bool is_index(int i, std::size_t size) { return i >= 0 && static_cast<std::size_t>(i) < size; }

void check_points(const BaProblem& problem) {
  for (std::size_t i = 0; i < problem.points.size(); ++i)
    if (!is_index(problem.points[i].host, problem.poses.size()))
      malformed("the host of point " + std::to_string(i) + " is not a pose", "host is an index into poses");
}

[[noreturn]] void malformed_observation(std::size_t i, const std::string& what, const std::string& remedy) {
  malformed("observation " + std::to_string(i) + " " + what, remedy);
}

void check_observations(const BaProblem& problem) {
  int last_point = 0;
  for (std::size_t i = 0; i < problem.observations.size(); ++i) {
    const BaObservation& o = problem.observations[i];
    if (!is_index(o.point, problem.points.size()))
      malformed_observation(i, "has no point", "point is an index into points");
    if (!is_index(o.target, problem.poses.size()))
      malformed_observation(i, "has no pose", "target is an index into poses");
    if (o.target == problem.points[o.point].host)
      malformed_observation(i, "is of a point in its own host", "leave it out: it says nothing");
    if (o.point < last_point) malformed_observation(i, "is out of order", "sort observations by point");
    last_point = o.point;
  }
}

void check_corners(const BaProblem& problem) {
  for (const BaCornerPair& c : problem.corners)
    if (!is_index(c.from, problem.poses.size()) || !is_index(c.to, problem.poses.size()) || c.from == c.to)
      malformed("a corner is not seen in two poses", "from and to are two indices into poses");
}

void check_turns(const BaProblem& problem) {
  for (const BaTurn& t : problem.turns)
    if (!is_index(t.from, problem.poses.size()) || !is_index(t.to, problem.poses.size()) || t.from == t.to)
      malformed("a turn is not between two poses", "from and to are two indices into poses");
}

void check_prior(const BaProblem& problem) {
  const BaPrior& prior = *problem.prior;
  const auto n = static_cast<Eigen::Index>(6 * prior.pose_ids.size());
  if (prior.linearization.size() != prior.pose_ids.size() || prior.H.rows() != n || prior.H.cols() != n ||
      prior.b.size() != n)
    malformed("the sizes of the prior disagree",
              "n poses need n linearisation points, a 6n x 6n H and 6n values in b");
  for (const int id : prior.pose_ids) {
    std::size_t found = 0;
    for (const int pose_id : problem.pose_ids) found += pose_id == id;
    if (found != 1)
      malformed("the prior names pose " + std::to_string(id) + ", which pose_ids contains " +
                    std::to_string(found) + " times",
                "marginalise poses that leave the window");
  }
}

bool is_finite(const BaPoint& p) {
  return p.ray.allFinite() && std::isfinite(p.idepth) && std::isfinite(p.known_idepth) &&
         std::isfinite(p.known_information);
}

bool is_finite(const BaObservation& o) {
  return o.px.allFinite() && o.normal.allFinite() && std::isfinite(o.inv_sigma_normal) &&
         std::isfinite(o.inv_sigma_tangent);
}

bool is_finite(const BaCornerPair& c) {
  return c.ray_from.allFinite() && c.ray_to.allFinite() && std::isfinite(c.inv_sigma);
}

bool is_finite(const BaPrior& prior) {
  for (const SE3& T : prior.linearization)
    if (!T.is_finite()) return false;
  return prior.H.allFinite() && prior.b.allFinite() && std::isfinite(prior.constant);
}

}  // namespace

void check_problem(const BaProblem& problem) {
  if (!problem.pose_ids.empty() && problem.pose_ids.size() != problem.poses.size())
    malformed("pose_ids and poses differ in size", "name every pose, or none");
  check_points(problem);
  check_observations(problem);
  check_corners(problem);
  check_turns(problem);
  if (problem.prior) check_prior(problem);
}

bool is_finite(const BaProblem& problem) {
  for (const BaPose& pose : problem.poses)
    if (!pose.T_cam_world.is_finite()) return false;
  for (const BaPoint& p : problem.points)
    if (!is_finite(p)) return false;
  for (const BaObservation& o : problem.observations)
    if (!is_finite(o)) return false;
  for (const BaCornerPair& corner : problem.corners)
    if (!is_finite(corner)) return false;
  for (const BaTurn& t : problem.turns)
    if (!t.R_to_from.coeffs().allFinite() || !t.information.allFinite()) return false;
  const Pinhole& c = problem.pinhole;
  return std::isfinite(c.fx) && std::isfinite(c.fy) && std::isfinite(c.cx) && std::isfinite(c.cy) &&
         (!problem.prior || is_finite(*problem.prior));
}

bool has_unknowns(const BaProblem& problem) {
  bool free_pose = false;
  for (const BaPose& pose : problem.poses) free_pose |= !pose.fixed;
  const bool has_pairs = !problem.corners.empty() || !problem.turns.empty();
  if (free_pose && (!problem.observations.empty() || has_pairs || problem.prior)) return true;
  for (const BaObservation& o : problem.observations)
    if (!problem.points[o.point].fixed) return true;
  return false;
}

}  // namespace edgevo::ba
