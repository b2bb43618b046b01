// SPDX-License-Identifier: BSD-3-Clause
#include "thin_obstacles.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "surface_distance.h"

namespace edgevo::test {
namespace {

constexpr double kMinThick = 0.05, kMaxThick = 0.15, kMinLength = 0.5;
constexpr double kParallel = 0.995;   // cosine between the axes of two faces of one bar
constexpr double kMinSeen = 0.5;      // metres of a bar
constexpr double kFree = 0.3;         // metres from the middle of the axis to any other surface
constexpr double kStep = 0.05;        // metres along a bar
constexpr double kEnoughShare = 0.8;  // of its seen length
constexpr int kKeyframes = 3;
constexpr double kInFront = 0.2;  // metres in front of the axis that belong to the bar itself

// Centre line of a narrow face.
struct Strip {
  Eigen::Vector3d begin, end, across;
  Eigen::Vector3d direction() const { return (end - begin).normalized(); }
};

std::optional<Strip> strip_of(const Surface& s) {
  const bool is_long_u = s.side_u.norm() > s.side_v.norm();
  const Eigen::Vector3d& along = is_long_u ? s.side_u : s.side_v;
  const Eigen::Vector3d& across = is_long_u ? s.side_v : s.side_u;
  if (s.is_triangle || along.norm() < kMinLength || across.norm() > kMaxThick) return std::nullopt;
  const Eigen::Vector3d begin = s.origin + 0.5 * across;
  return Strip{begin, begin + along, across};
}

// Whether two faces belong to one bar: parallel and side by side over most of their length.
bool is_same_bar(const Strip& a, const Strip& b) {
  const Eigen::Vector3d d = a.direction();
  if (std::abs(d.dot(b.direction())) < kParallel) return false;
  const Eigen::Vector3d offset = 0.5 * (b.begin + b.end) - 0.5 * (a.begin + a.end);
  const double along = std::abs(d.dot(offset)), off = (offset - d.dot(offset) * d).norm();
  return off < kMaxThick && along < 0.3 * (a.end - a.begin).norm();
}

// The largest extent of the faces' corners across the axis.
double thickness_of(const std::vector<Strip>& faces, const Eigen::Vector3d& d) {
  std::vector<Eigen::Vector3d> corners;
  for (const Strip& f : faces)
    for (const double side : {-0.5, 0.5}) corners.push_back(f.begin + side * f.across);
  double thick = 0;
  for (const Eigen::Vector3d& a : corners)
    for (const Eigen::Vector3d& b : corners) {
      const Eigen::Vector3d offset = b - a;
      thick = std::max(thick, (offset - d.dot(offset) * d).norm());
    }
  return thick;
}

ThinObstacle bar_of(const std::vector<Strip>& faces) {
  const Eigen::Vector3d d = faces[0].direction();
  ThinObstacle bar{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), thickness_of(faces, d)};
  for (const Strip& f : faces) {
    const bool is_turned = d.dot(f.direction()) < 0;
    bar.begin += (is_turned ? f.end : f.begin) / double(faces.size());
    bar.end += (is_turned ? f.begin : f.end) / double(faces.size());
  }
  return bar;
}

// No surface but its own faces lies near the middle of the bar.
bool stands_free(const ThinObstacle& o, const World& world) {
  const Eigen::Vector3d middle = 0.5 * (o.begin + o.end);
  for (const Surface& s : world.surfaces) {
    const std::optional<Strip> strip = strip_of(s);
    const bool is_face = strip && (0.5 * (strip->begin + strip->end) - middle).norm() < kMaxThick;
    if (!is_face && distance_to(world, s, middle, kFree) < kFree) return false;
  }
  return true;
}

bool is_upright(const ThinObstacle& o) { return std::abs((o.end - o.begin).normalized().z()) > 0.9; }

// The voxel or one of its neighbours.
bool is_occupied_around(const octomap::OcTree& tree, const Eigen::Vector3d& p) {
  const double voxel = tree.getResolution();
  for (int n = 0; n < 27; ++n) {
    const Eigen::Vector3d q = p + voxel * Eigen::Vector3d(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
    const auto* node = tree.search(q.x(), q.y(), q.z());
    if (node && tree.isNodeOccupied(node)) return true;
  }
  return false;
}

}  // namespace

std::vector<ThinObstacle> thin_obstacles(const World& world) {
  std::vector<std::vector<Strip>> bars;
  for (const Surface& s : world.surfaces) {
    const std::optional<Strip> strip = strip_of(s);
    if (!strip) continue;
    const auto bar = std::find_if(bars.begin(), bars.end(),
                                  [&](const std::vector<Strip>& b) { return is_same_bar(b[0], *strip); });
    if (bar == bars.end())
      bars.push_back({*strip});
    else
      bar->push_back(*strip);
  }
  std::vector<ThinObstacle> obstacles;
  for (const std::vector<Strip>& faces : bars) {
    const ThinObstacle bar = bar_of(faces);
    if (faces.size() >= 2 && bar.thickness >= kMinThick && bar.thickness <= kMaxThick &&
        stands_free(bar, world))
      obstacles.push_back(bar);
  }
  return obstacles;
}

std::ostream& operator<<(std::ostream& out, const ThinFigures& f) {
  return out << f.occupied << " of " << f.obstacles
             << " thin obstacles occupied over 80 % of their seen length, upright ones " << f.upright_occupied
             << " of " << f.upright << "; " << f.occupied_length << " of " << f.length << " m occupied";
}

ThinFigures evaluate_thin(const std::vector<ThinObstacle>& obstacles, const TrueScene& truth,
                          const octomap::OcTree& tree, double range) {
  ThinFigures figures;
  for (const ThinObstacle& o : obstacles) {
    const double length = (o.end - o.begin).norm();
    int seen = 0, occupied = 0;
    for (double s = 0.5 * kStep; s < length; s += kStep) {
      const Eigen::Vector3d p = o.begin + s / length * (o.end - o.begin);
      if (truth.keyframes_that_see(p, range, kInFront) < kKeyframes) continue;
      ++seen, occupied += is_occupied_around(tree, truth.T_map_scene() * p);
    }
    if (kStep * seen < kMinSeen) continue;
    const double share = double(occupied) / seen;
    figures.shares.emplace_back(o, share);
    ++figures.obstacles, figures.occupied += share >= kEnoughShare;
    if (is_upright(o)) ++figures.upright, figures.upright_occupied += share >= kEnoughShare;
    figures.length += kStep * seen, figures.occupied_length += kStep * occupied;
  }
  return figures;
}

}  // namespace edgevo::test
