#pragma once
// A BaProblem laid out for speed: points sorted by host, each with its observations side by side and sorted
// by target, and each observation reduced to two linear functions of the projected ray. Built once a solve;
// never changed by it.
#include <vector>

#include "edgevo/bundle_adjustment/bundle_adjustment.h"

namespace edgevo::ba {

/// A point nearer to the target camera's plane than this share of its depth in the host counts as behind the
/// camera. No patch grows a thousandfold and is matched: what is nearer is a step gone wrong.
constexpr double kMinDepthRatio = 1e-3;
/// Residual, in pixels, charged to an observation that a step carried behind the camera: an image's width,
/// more than it could have in view, so that no step gains by hiding points.
constexpr double kHiddenResidualPx = 1000;

/// What a solve moves. Both are indexed as in the BaProblem.
struct State {
  std::vector<SE3> poses;  ///< T_cam_world
  std::vector<double> idepth;
};

/// R, t of T_target_host, the motion that all observations of a (host, target) pair share.
struct RelativePose {
  double R[9];  ///< row by row
  double t[3];
};
RelativePose relative_pose(const SE3& T_target_world, const SE3& T_host_world);

/// Two doubles in one register, on every 64-bit machine: here the normal row (0) and the tangent row (1) of
/// an observation. The compiler's vector type rather than Eigen's arrays, which go through memory when they
/// are put together from scalars.
using Rows = double __attribute__((vector_size(16)));

/// Whitened residual f[0] u + f[1] v + f[2] for the normalised image point (u, v) in the target.
struct PackedObservation {
  Rows f[3];
  double hidden_residual;  ///< whitened residual charged when behind the camera
  int target;
  int index;  ///< in BaProblem::observations
};

struct PackedPoint {
  double ray[3];
  int begin, end;  ///< range in PackedProblem::observations
  int index;       ///< in BaProblem::points
  bool fixed;
};

/// Targets of a host's points: first to last, none where last < first. Points are seen by keyframes near
/// their host only, so that a long problem is a band.
struct TargetRange {
  int first = 0, last = -1;
};

struct PackedProblem {
  int pose_count = 0;
  std::vector<int> host_begin;       ///< points of host h: [host_begin[h], host_begin[h + 1])
  std::vector<TargetRange> targets;  ///< per host
  std::vector<PackedPoint> points;
  std::vector<PackedObservation> observations;
};

/// Start of a solve: the problem's poses and depths, free depths not below `min_idepth`.
State initial_state(const BaProblem& problem, double min_idepth);
/// Points without a visible observation are left out, and so are those that `skip` (may be null) marks.
PackedProblem pack_problem(const BaProblem& problem, const State& state, const std::vector<bool>* skip);

/// Throws InputError for a malformed problem, see BundleAdjuster.
void check_problem(const BaProblem& problem);
/// No NaN, no infinity in anything that a solve reads.
bool is_finite(const BaProblem& problem);
/// Some pose or depth may move and some observation exists.
bool has_unknowns(const BaProblem& problem);

}  // namespace edgevo::ba
