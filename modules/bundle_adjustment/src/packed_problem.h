// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A BaProblem in a layout for speed: points sorted by host, each with contiguous observations sorted by
// target, and each observation reduced to two linear functions of the projected ray. Built once per solve and
// constant during it.
#include <vector>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"

namespace edgevo::ba {

/// A point closer to the target camera's plane than this share of its depth in the host counts as behind the
/// camera. No patch magnified a thousandfold is matched: anything closer is the result of a bad step.
constexpr double kMinDepthRatio = 1e-3;
/// Residual, pixels, of an observation that a step moved behind the camera: an image width, more than any in
/// view, so that no step gains by hiding points.
constexpr double kHiddenResidualPx = 1000;

/// Variables of a solve, indexed as in the BaProblem.
struct State {
  /// T_cam_world of each pose.
  std::vector<SE3> poses;
  std::vector<double> idepth;
};

/// R and t of T_target_host, shared by all observations of a (host, target) pair.
struct RelativePose {
  /// Rotation matrix, row by row.
  double R[9];
  double t[3];
};
RelativePose relative_pose(const SE3& T_target_host);
/// The same for every pair, at host * n + target.
std::vector<RelativePose> all_relative_poses(const std::vector<SE3>& poses);

/// Two doubles in one register on every 64-bit machine: the normal row (0) and the tangent row (1) of an
/// observation. The compiler's vector type, since Eigen's arrays go through memory when they are assembled
/// from scalars.
using Rows = double __attribute__((vector_size(16)));

/// Whitened residual f[0] u + f[1] v + f[2] for the normalised image point (u, v) in the target.
struct PackedObservation {
  Rows f[3];
  /// Whitened residual if the point is behind the camera.
  double hidden_residual;
  int target;
  /// Index into BaProblem::observations.
  int index;
};

struct PackedPoint {
  double ray[3];
  /// Range in PackedProblem::observations.
  int begin, end;
  /// Index into BaProblem::points.
  int index;
  bool fixed;
  /// As in BaPoint; information 0 if the depth is fixed.
  double known_idepth, known_information;
};

/// Targets of a host's points, first to last; none if last < first. Points are seen only by keyframes near
/// their host, so a long problem has a band matrix.
struct TargetRange {
  int first = 0, last = -1;
};

struct PackedProblem {
  int pose_count = 0;
  /// Points of host h: [host_begin[h], host_begin[h + 1]).
  std::vector<int> host_begin;
  /// Range of targets of each host.
  std::vector<TargetRange> targets;
  std::vector<PackedPoint> points;
  std::vector<PackedObservation> observations;
};

/// Start of a solve: the problem's poses and depths, free depths not below `min_idepth`.
State initial_state(const BaProblem& problem, double min_idepth);
/// Packs a problem without the points that have no visible observation or are marked in `skip` (may be null).
PackedProblem pack_problem(const BaProblem& problem, const State& state, const std::vector<bool>* skip);

/// Throws InputError for a malformed problem (BundleAdjuster).
void check_problem(const BaProblem& problem);
/// Whether all values that a solve reads are finite.
bool is_finite(const BaProblem& problem);
/// Whether a pose or depth is free and an observation exists.
bool has_unknowns(const BaProblem& problem);

}  // namespace edgevo::ba
