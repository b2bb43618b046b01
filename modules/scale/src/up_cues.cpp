// SPDX-License-Identifier: BSD-3-Clause
#include "up_cues.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "edgevo/core/angle.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/point_filter.h"

namespace edgevo {
namespace {

// ---- the direction of travel ----

constexpr double kReach = 0.1;          // median depths to each side of a pose, for its direction of travel
constexpr double kMinPath = 3;          // median depths: less is no drive
constexpr double kAlong = rad(12);      // a direction within this of the common one is along it
constexpr double kMinAlong = 0.7;       // share of the poses that moves along it
constexpr double kHalfWeight = rad(3);  // deviation at which a direction counts half
constexpr int kIterations = 20;
// The part of a deviation that does not average out: slip in turns, a path that bends.
constexpr double kTravelSigma = rad(0.3);
constexpr double kPathPerSample = 1;  // median depths: nearer directions share their errors

std::vector<Eigen::Vector3d> travel_directions(const Path& path, double reach) {
  std::vector<Eigen::Vector3d> directions;
  for (size_t j = 0, a = 0, b = 0; j < path.size(); ++j) {
    while (a + 1 < j && path[j].distance - path[a + 1].distance >= reach) ++a;
    while (b + 1 < path.size() && path[b].distance - path[j].distance < reach) ++b;
    const Eigen::Vector3d chord = path[b].T_world_cam.translation() - path[a].T_world_cam.translation();
    if (chord.norm() < reach) continue;
    directions.push_back(path[j].T_world_cam.rotation().conjugate() * chord.normalized());
  }
  return directions;
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

// The direction that most others are near.
Eigen::Vector3d common_direction(const std::vector<Eigen::Vector3d>& directions) {
  Eigen::Vector3d common = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& d : directions) common += d;
  for (int i = 0; i < kIterations; ++i) {
    common.normalize();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& d : directions) {
      const double off = angle_between(d, common) / kHalfWeight;
      sum += d / (1 + off * off);
    }
    common = sum;
  }
  return common.normalized();
}

// ---- the ground ----

constexpr double kNear = 1;                // median depths: points further aside are not looked at
constexpr int kDirections = 180;           // of the search, 2 degrees each
constexpr double kSector = rad(45);        // to each side of a direction
constexpr double kGroundBand = 0.06;       // relative half width of the ground in height
constexpr int kMinGround = 60;             // points
constexpr double kMaxOpposite = 0.5;       // of the ground's points, at one height opposite
constexpr double kOppositeRatio = 1.5;     // of the heights
constexpr double kMinGroundShare = 0.75;   // of the points in the sector: drives give 0.96, walls 0.5
constexpr double kGroundSigma = rad(0.7);  // camber and kerbs

// A point as the camera passes it: its offset across the travel.
using Offset = Eigen::Vector2d;  // down, right

// Between the last pose at which the point lies ahead and the first at which it does not. nullopt: not
// passed, or level with the host already.
std::optional<Offset> offset_when_passed(const Path& path, size_t host, const Eigen::Vector3d& p_world,
                                         const TravelAxes& axes) {
  double ahead = 0;
  Offset before = Offset::Zero();
  for (size_t j = host; j < path.size(); ++j) {
    const SE3& T = path[j].T_world_cam;
    const Eigen::Vector3d p = T.rotation().conjugate() * (p_world - T.translation());
    const Offset offset(p.dot(axes.down), p.dot(axes.right));
    const double now = p.dot(axes.forward);
    if (now > 0) {
      ahead = now, before = offset;
      continue;
    }
    if (j == host) return std::nullopt;
    const double share = ahead / (ahead - now);
    return Offset((1 - share) * before + share * offset);
  }
  return std::nullopt;
}

std::vector<Offset> offsets(const Drive& drive, const TravelAxes& axes) {
  std::vector<Offset> all;
  const PointFilter filter;
  for (const KeyframeRecord& k : drive.run->keyframes) {
    const Path& path = drive.paths.at(k.segment);
    const auto host = std::lower_bound(path.begin(), path.end(), k.frame_index,
                                       [](const PathPose& p, int index) { return p.frame_index < index; });
    for (const EdgePoint& point : k.points) {
      if (!filter.keeps(point)) continue;
      const auto offset =
          offset_when_passed(path, size_t(host - path.begin()),
                             k.T_world_cam * point_in_camera(drive.run->pinhole, point), axes);
      if (offset && offset->norm() < kNear * drive.depth) all.push_back(*offset);
    }
  }
  return all;
}

// The ground as one direction would show it.
struct GroundGuess {
  double angle = 0, height = 0;
  /// Points at that height, and whether most of the sector's points lie there.
  int points = 0;
  bool is_flat = false;
};

// The height at which most points of the sector lie, in steps of half the band.
GroundGuess ground_at(const std::vector<Offset>& offsets, double angle) {
  const Offset down(std::cos(angle), std::sin(angle)), right(-down.y(), down.x());
  std::vector<double> logs;
  int in_sector = 0;
  for (const Offset& p : offsets)
    if (p.dot(down) > 0 && std::abs(p.dot(right)) < std::tan(kSector) * p.dot(down))
      logs.push_back(std::log(p.dot(down))), ++in_sector;
  std::sort(logs.begin(), logs.end());
  GroundGuess best{angle};
  for (size_t a = 0, b = 0; a < logs.size(); ++a) {
    while (b < logs.size() && logs[b] - logs[a] < 2 * kGroundBand) ++b;
    if (int(b - a) > best.points)
      best.points = int(b - a), best.height = std::exp(0.5 * (logs[a] + logs[b - 1]));
  }
  best.is_flat = best.points >= kMinGround && best.points >= kMinGroundShare * in_sector;
  return best;
}

// Whether a surface of that size and distance lies opposite, or nearly so.
bool has_counterpart(const std::vector<Offset>& offsets, const GroundGuess& ground) {
  for (int i = -2; i <= 2; ++i) {
    const GroundGuess other = ground_at(offsets, ground.angle + kPi + i * kSector / 2);
    if (other.points >= kMaxOpposite * ground.points && other.height < kOppositeRatio * ground.height &&
        ground.height < kOppositeRatio * other.height)
      return true;
  }
  return false;
}

// Turns the guess until the ground's points are level. Returns the standard deviation of the angle.
double level_ground(const std::vector<Offset>& offsets, GroundGuess* ground) {
  double sigma = 0;
  for (int i = 0; i < kIterations; ++i) {
    const Offset down(std::cos(ground->angle), std::sin(ground->angle)), right(-down.y(), down.x());
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
    for (const Offset& p : offsets) {
      const double x = p.dot(right), y = p.dot(down) - ground->height;
      if (std::abs(y) > kGroundBand * ground->height || std::abs(x) > ground->height) continue;
      n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y, syy += y * y;
    }
    if (n < kMinGround / 2.0 || n * sxx - sx * sx <= 0) break;
    const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx), spread = sxx / n - (sx / n) * (sx / n);
    ground->height += (sy - slope * sx) / n;
    ground->angle -= std::atan(slope);
    const double residual = std::max(0.0, syy / n - (sy / n) * (sy / n) - slope * slope * spread);
    sigma = std::sqrt(residual / spread / n);
  }
  return sigma;
}

// ---- lines ----

constexpr double kLineSigma = rad(6);  // of a line's direction; less certain ones are not used
constexpr double kAcross = rad(12);    // from perpendicular to the travel
constexpr double kPeak = rad(3);       // half width of the peak
constexpr double kMinPeakShare = 0.3;
constexpr int kMinLines = 20;
constexpr double kLineFloor = rad(1.5), kLinesSigma = rad(0.3);

struct LineAngle {
  double angle = 0, weight = 0;
};

void add_line(const Pinhole& pinhole, const EdgeLine& line, const TravelAxes& axes,
              std::vector<LineAngle>* all) {
  if (!line.is_straight || line.vertices.size() < 2) return;
  const EdgeVertex &a = line.vertices.front(), &b = line.vertices.back();
  const Eigen::Vector3d p = point_in_camera(pinhole, a), q = point_in_camera(pinhole, b), d = q - p;
  const double length = d.norm();
  if (!(length > 0)) return;
  const double sigma =
      std::hypot(p.z() * a.idepth_sigma / a.idepth, q.z() * b.idepth_sigma / b.idepth) / length;
  if (sigma > kLineSigma || std::abs(d.dot(axes.forward)) > std::sin(kAcross) * length) return;
  all->push_back({axes.angle_of(d), 1 / (sigma * sigma + kLineFloor * kLineFloor)});
}

// Difference of two angles, modulo `period`, -period/2 to period/2.
double difference(double a, double b, double period) { return std::remainder(a - b, period); }

double weight_near(const std::vector<LineAngle>& lines, double angle, double* mean, int* count) {
  double weights = 0, sum = 0;
  int n = 0;
  for (const LineAngle& l : lines) {
    const double off = difference(l.angle, angle, kPi / 2);
    if (std::abs(off) > kPeak) continue;
    weights += l.weight, sum += l.weight * off, ++n;
  }
  if (mean) *mean = angle + (weights > 0 ? sum / weights : 0);
  if (count) *count = n;
  return weights;
}

// ---- turns ----

constexpr double kMinTurn = rad(15);  // in all
constexpr double kTurnSigma = rad(1);
constexpr double kMaxTurnSigma = rad(5);

}  // namespace

Drive drive_of(const Run& run) {
  Drive drive{&run, {}, 0};
  std::vector<double> depths;
  const PointFilter filter;
  for (const KeyframeRecord& k : run.keyframes) {
    extend(k.frame_index, k.time, k.T_world_cam, &drive.paths[k.segment]);
    for (const EdgePoint& p : k.points)
      if (filter.keeps(p)) depths.push_back(1 / double(p.idepth));
  }
  drive.depth = median(std::move(depths));
  return drive;
}

std::optional<TravelAxes> travel_axes(const Drive& drive) {
  std::vector<Eigen::Vector3d> directions;
  double length = 0;
  for (const auto& [segment, path] : drive.paths) {
    const auto more = travel_directions(path, kReach * drive.depth);
    directions.insert(directions.end(), more.begin(), more.end());
    length += path.back().distance;
  }
  if (drive.depth <= 0 || length < kMinPath * drive.depth || directions.empty()) return std::nullopt;
  TravelAxes axes;
  axes.forward = common_direction(directions);
  double squares = 0;
  int along = 0;
  for (const Eigen::Vector3d& d : directions) {
    const double off = angle_between(d, axes.forward);
    if (off < kAlong) squares += off * off, ++along;
  }
  if (along < kMinAlong * double(directions.size())) return std::nullopt;
  const double samples = std::max(1.0, length / (kPathPerSample * drive.depth));
  axes.sigma = std::sqrt(0.5 * squares / along / samples + kTravelSigma * kTravelSigma);
  // The axis of the image that is more nearly across the travel: y, but for a camera that looks up or down.
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d& reference = std::abs(axes.forward.y()) <= std::abs(axes.forward.z()) + 0.5 ? y : z;
  axes.down = (reference - reference.dot(axes.forward) * axes.forward).normalized();
  axes.right = axes.down.cross(axes.forward);
  return axes;
}

std::optional<UpCue> ground_cue(const Drive& drive, const TravelAxes& axes) {
  const std::vector<Offset> points = offsets(drive, axes);
  GroundGuess best;
  for (int i = 0; i < kDirections; ++i) {
    const GroundGuess guess = ground_at(points, 2 * kPi * i / kDirections);
    if (!guess.is_flat || guess.points <= best.points) continue;
    // Two walls, or a floor under a ceiling, leave two directions for up.
    if (!has_counterpart(points, guess)) best = guess;
  }
  if (best.points == 0) return std::nullopt;
  const double sigma = level_ground(points, &best);
  return UpCue{"ground", best.angle, std::hypot(sigma, kGroundSigma), 2 * kPi};
}

std::optional<UpCue> line_cue(const Drive& drive, const TravelAxes& axes) {
  std::vector<LineAngle> lines;
  for (const KeyframeRecord& k : drive.run->keyframes)
    for (const EdgeLine& line : k.lines) add_line(drive.run->pinhole, line, axes, &lines);
  double all = 0, best = 0, angle = 0;
  for (const LineAngle& l : lines) all += l.weight;
  for (double a = 0; a < kPi / 2; a += rad(1))
    if (const double w = weight_near(lines, a, nullptr, nullptr); w > best) best = w, angle = a;
  int count = 0;
  for (int i = 0; i < kIterations; ++i) best = weight_near(lines, angle, &angle, &count);
  if (count < kMinLines || best < kMinPeakShare * all) return std::nullopt;
  return UpCue{"vertical lines", angle, std::hypot(kPeak / 2 / std::sqrt(count), kLinesSigma), kPi / 2};
}

std::optional<UpCue> turn_cue(const Drive& drive, const TravelAxes& axes) {
  Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
  double turned = 0;
  for (const auto& [segment, path] : drive.paths)
    for (size_t i = 0, j = 0; i < path.size(); i = j) {
      while (j < path.size() && path[j].distance - path[i].distance < drive.depth) ++j;
      if (j == path.size()) break;
      const Vector6d xi = (path[i].T_world_cam.inverse() * path[j].T_world_cam).log();
      const Eigen::Vector2d w(xi.tail<3>().dot(axes.down), xi.tail<3>().dot(axes.right));
      sum += w * w.transpose(), turned += w.norm();
    }
  if (turned < kMinTurn) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(sum);
  const double sigma = std::sqrt(std::max(0.0, eigen.eigenvalues()[0]) / eigen.eigenvalues()[1]);
  if (sigma > kMaxTurnSigma) return std::nullopt;
  const Eigen::Vector2d axis = eigen.eigenvectors().col(1);
  return UpCue{"turns", std::atan2(axis.y(), axis.x()), std::hypot(sigma, kTurnSigma), kPi};
}

}  // namespace edgevo
