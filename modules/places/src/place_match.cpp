// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/places/place_match.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "corner_pose.h"
#include "edgevo/alignment/edge_alignment.h"
#include "edgevo/alignment/pose_evidence.h"
#include "edgevo/core/angle.h"
#include "edgevo/core/order_statistics.h"
#include "false_alarms.h"

namespace edgevo {
namespace {

// Turns of the camera that displace all edges, in pixels of the level: beyond what an edge agrees within, and
// within the view.
constexpr double kDisplacedPx[] = {8, 14, 22};
// From where the next best pose is looked for: as far as an edge is attracted from.
constexpr double kNextBestPx = 11;
// A place has all six directions measured: to a tenth of the median depth, and a degree.
constexpr double kMaxShare = 0.1, kMaxRotation = rad(1);
// Points of both maps on one edge, pixels of the finest level, and their least number.
constexpr float kSamePointPx = 2;
constexpr size_t kMinDepths = 20;
// Depths along an edge have common errors: about so many of them are one measurement.
constexpr double kPointsPerEdge = 10;

const AlignmentParams kParams;

// The edges of one view in the image of the other.
struct AlignedEdges {
  SE3 T_to_from;
  Matrix6d covariance = Matrix6d::Zero();
  double share = 0, chance = 0, log_alarms = 0;
};

double mean_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return values.empty() ? 0 : sum / double(values.size());
}

// The camera turned aside.
SE3 displaced(const SE3& T_to_from, double angle, int direction) {
  const double turn = direction * M_PI / 4;
  Vector6d xi = Vector6d::Zero();
  xi[3] = angle * std::cos(turn), xi[4] = angle * std::sin(turn);
  return SE3::exp(xi) * T_to_from;
}

// Share of the edges that agree by chance: of the camera turned aside, or where next to the pose they fit
// best, such as those of a fence one board on.
double chance_share(const FramePyramid& to, const ReferenceCloud& cloud, const SE3& T_to_from) {
  const double per_px = 1 / to.finest().pinhole.fx;
  std::vector<double> shares;
  double next_best = 0;
  for (int direction = 0; direction < 8; ++direction) {
    for (const double px : kDisplacedPx)
      shares.push_back(
          weigh_evidence(to, cloud, displaced(T_to_from, px * per_px, direction), kParams).inlier_share);
    SE3 other = displaced(T_to_from, kNextBestPx * per_px, direction);
    align_edges(to, cloud, 0, kParams, &other);
    const double apart = other.is_finite() ? (other * T_to_from.inverse()).log().tail<3>().norm() : 0;
    if (apart > 0.5 * kNextBestPx * per_px)
      next_best = std::max(next_best, weigh_evidence(to, cloud, other, kParams).inlier_share);
  }
  return std::max(mean_of(shares), next_best);
}

int edges_in(const std::vector<PoseEquation>& equations) {
  std::set<int> edges;
  for (const PoseEquation& e : equations) edges.insert(e.edge);
  return int(edges.size());
}

AlignedEdges align_with(const FramePyramid& to, const ReferenceCloud& cloud, const SE3& start) {
  AlignedEdges found;
  found.T_to_from = start;
  align_edges(to, cloud, 0, kParams, &found.T_to_from);
  if (!found.T_to_from.is_finite()) return found;
  const std::vector<PoseEquation> equations = pose_equations(to, cloud, found.T_to_from, kParams);
  found.covariance = pose_covariance(equations);
  found.share = weigh_evidence(to, cloud, found.T_to_from, kParams).inlier_share;
  found.chance = chance_share(to, cloud, found.T_to_from);
  found.log_alarms = log_alarms_of_share(edges_in(equations), found.share, found.chance);
  return found;
}

double median_depth(const std::vector<CloudPoint>& points) {
  std::vector<double> depths;
  for (const CloudPoint& p : points)
    if (p.idepth > 0) depths.push_back(1 / p.idepth);
  return depths.empty() ? 0 : median(std::move(depths));
}

bool measures_all(const Matrix6d& covariance, double depth) {
  const Vector6d sigmas = covariance.diagonal().cwiseSqrt();
  return sigmas.head<3>().maxCoeff() < kMaxShare * depth && sigmas.tail<3>().maxCoeff() < kMaxRotation;
}

// Logarithm of a length in map a over the same length in map b.
struct UnitRatio {
  double log = 0, sigma = 0;
};

// By the depths of points that lie on one edge in view b.
std::optional<UnitRatio> compare_depths(const Pinhole& pinhole, const std::vector<CloudPoint>& a,
                                        const SE3& T_b_a, const std::vector<CloudPoint>& b) {
  const NearestPoint nearest(pinhole, b, kSamePointPx);
  std::vector<double> logs;
  for (const CloudPoint& p : a) {
    const Projection seen = project(pinhole, T_b_a.R(), T_b_a.translation(), p.ray, p.idepth);
    if (!seen.valid || !(p.idepth > 0)) continue;
    const CloudPoint* other = nearest.find(seen.px.cast<float>());
    if (!other || p.normal.dot(other->normal) < kMinNormalCosine) continue;
    logs.push_back(std::log(seen.Y.z() / p.idepth * other->idepth));
  }
  if (logs.size() < kMinDepths) return std::nullopt;
  const double middle = median(logs);
  std::vector<double> off;
  for (const double x : logs) off.push_back(std::abs(x - middle));
  const double spread = 1.4826 * median(std::move(off)), count = double(logs.size()) / kPointsPerEdge;
  return UnitRatio{middle, std::max(0.002, 1.2533 * spread / std::sqrt(std::max(1.0, count)))};
}

ReferenceCloud cloud_of(const PlaceView& v) {
  ReferenceCloud cloud;
  cloud.points = v.points;
  return cloud;
}

// Corners and edges fail differently: that both agree by chance is the product of what each says. Edges that
// agree hardly more than by chance do not confirm the pose.
bool is_proved(double corners_log_alarms, double edges_log_alarms) {
  constexpr double kLogConfirmed = -2;  // one of a hundred poses by chance: three are tried for each view
  return edges_log_alarms < kLogConfirmed && corners_log_alarms + edges_log_alarms < 2 * kLogProof;
}

// What the two directions differ by is an error of one of them.
Matrix7d covariance_of(const LocatedView& there, const SE3& T_b_a_by_return, const UnitRatio& ratio) {
  const Vector6d differing = (there.T_a_b.inverse() * T_b_a_by_return.inverse()).log();
  const Matrix6d of_b = there.covariance + differing * differing.transpose();
  Matrix7d covariance = Matrix7d::Zero();
  covariance.topLeftCorner<6, 6>() = of_b;
  // The unit of map b: about the camera of view b.
  covariance(6, 6) = ratio.sigma * ratio.sigma;
  const Matrix7d moved = Sim3{1, there.T_a_b}.adjoint();  // of the inverse
  return moved * covariance * moved.transpose();
}

void note(const AlignedEdges& found, int direction, PlaceEvidence* evidence) {
  evidence->share[direction] = found.share, evidence->chance[direction] = found.chance;
  evidence->edges_log_alarms =
      direction == 0 ? found.log_alarms : std::max(evidence->edges_log_alarms, found.log_alarms);
}

}  // namespace

std::optional<LocatedView> locate_view(const Pinhole& pinhole, const PlaceView& a, const RememberedView& b,
                                       PlaceEvidence* evidence) {
  PlaceEvidence unused;
  if (!evidence) evidence = &unused;
  *evidence = {};
  const std::optional<CornerPose> corners = pose_by_corners(pinhole, a, b, evidence);
  if (!corners || evidence->corners_log_alarms > kLogProof) return std::nullopt;
  const AlignedEdges there = align_with(unpack(b.edges), cloud_of(a), corners->T_b_a);
  note(there, 0, evidence);
  const double depth = median_depth(a.points);
  if (!is_proved(evidence->corners_log_alarms, there.log_alarms) || !measures_all(there.covariance, depth))
    return std::nullopt;
  return LocatedView{there.T_to_from.inverse(), there.covariance, depth, *evidence};
}

std::optional<PlaceMatch> match_views(const Pinhole& pinhole, const PlaceView& a, const PlaceView& b,
                                      PlaceEvidence* evidence) {
  PlaceEvidence unused;
  if (!evidence) evidence = &unused;
  const std::optional<LocatedView> there = locate_view(pinhole, a, b.view, evidence);
  if (!there) return std::nullopt;
  const std::optional<UnitRatio> ratio = compare_depths(pinhole, a.points, there->T_a_b.inverse(), b.points);
  if (!ratio) return std::nullopt;
  const Sim3 T_a_b{std::exp(ratio->log), there->T_a_b};
  const SE3 back_start(T_a_b.rigid.rotation(), T_a_b.rigid.translation() / T_a_b.scale);
  const AlignedEdges back = align_with(unpack(a.view.edges), cloud_of(b), back_start);
  note(back, 1, evidence);
  if (!is_proved(evidence->corners_log_alarms, back.log_alarms)) return std::nullopt;
  const SE3 T_b_a_by_return =
      SE3(back.T_to_from.rotation(), T_a_b.scale * back.T_to_from.translation()).inverse();
  PlaceMatch match{T_a_b, covariance_of(*there, T_b_a_by_return, *ratio), *evidence};
  if (!measures_all(match.covariance.topLeftCorner<6, 6>(), there->median_depth)) return std::nullopt;
  return match;
}

}  // namespace edgevo
