// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/segmentation/group_motion.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "edgevo/alignment/edge_match.h"
#include "edgevo/core/order_statistics.h"

namespace edgevo {
namespace {

constexpr int kIterations = 8;           // on each level
constexpr double kAgreePx = 1.0;         // along the normal: as for an inlier of a pose
constexpr double kDisplacedPx = 9;       // of the copies that show what texture gives
constexpr size_t kMaxGroupPixels = 120;  // of a group: enough for three numbers
constexpr double kSlidPx = 4;            // along the edge, of a match that counts

constexpr double kNearest = 10;        // median inverse depths: the nearest that the scene may be
constexpr double kFixedPx = 1.5;       // of a group that keeps its place
constexpr double kFixedGrowth = 0.01;  // and its size

struct LevelMatch {
  bool found = false;
  Eigen::Vector2d normal;
  double residual_px = 0, along_px = 0;
  int edge = -1;
  bool agrees() const { return found && std::abs(residual_px) < kAgreePx && std::abs(along_px) < kSlidPx; }
};

LevelMatch match_pixel(const PyramidLevel& level, const Eigen::Vector2d& px, const Eigen::Vector2f& normal) {
  const int n = level.field.nearest(float(px.x()), float(px.y()));
  if (n < 0) return {};
  const EdgePixel& edge = level.edges.pixels[size_t(n)];
  if (!(edge.normal().dot(normal) >= kMinNormalCosine)) return {};
  const Eigen::Vector2d g = edge.normal().cast<double>(), d = px - edge.position().cast<double>();
  return {true, g, g.dot(d), g.x() * d.y() - g.y() * d.x(), n};
}

// One step of iterated closest points: shift and change of size from the residuals along the normals. False
// if they do not determine it.
bool improve(const PyramidLevel& level, double pixels_per_level, const std::vector<OrientedPixel>& group,
             double width_px, ImageSimilarity* motion) {
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const OrientedPixel& p : group) {
    const LevelMatch m = match_pixel(level, (*motion)(p.px) / pixels_per_level, p.normal);
    if (!m.found) continue;
    const double r = m.residual_px * pixels_per_level;
    const double w = 1 / (1 + r * r / (width_px * width_px));  // Cauchy: many matches are another edge's
    const Eigen::Vector3d J(m.normal.x(), m.normal.y(), m.normal.dot(p.px - motion->centre));
    H += w * J * J.transpose();
    b += w * r * J;
  }
  H.diagonal() += Eigen::Vector3d(1e-3, 1e-3, 10);  // solvable for a single edge
  const Eigen::Vector3d step = -H.ldlt().solve(b);
  if (!step.allFinite()) return false;
  motion->shift += step.head<2>();
  motion->scale = std::clamp(motion->scale + step.z(), 0.3, 3.0);
  return step.head<2>().norm() + std::abs(step.z()) * 100 > 0.02;
}

}  // namespace

std::vector<OrientedPixel> thinned(const std::vector<OrientedPixel>& pixels, size_t most) {
  if (pixels.size() <= most) return pixels;
  std::vector<OrientedPixel> some;
  for (size_t i = 0; i < most; ++i) some.push_back(pixels[i * pixels.size() / most]);
  return some;
}

double agreeing_share(const PyramidLevel& finest, const std::vector<OrientedPixel>& group,
                      const ImageSimilarity& motion) {
  if (group.empty()) return 0;
  const auto agrees = [&](const OrientedPixel& p) {
    return match_pixel(finest, motion(p.px), p.normal).agrees();
  };
  return double(std::count_if(group.begin(), group.end(), agrees)) / double(group.size());
}

std::vector<OrientedPixel> moved_edges(const PyramidLevel& finest, const std::vector<OrientedPixel>& group,
                                       const ImageSimilarity& motion) {
  std::vector<OrientedPixel> moved;
  for (const OrientedPixel& p : group)
    if (const LevelMatch m = match_pixel(finest, motion(p.px), p.normal); m.agrees()) {
      const EdgePixel& edge = finest.edges.pixels[size_t(m.edge)];
      moved.push_back({edge.position().cast<double>(), edge.normal()});
    }
  return moved;
}

GroupMotion align_group(const FramePyramid& current, const std::vector<OrientedPixel>& all,
                        const std::vector<ImageSimilarity>& starts) {
  const std::vector<OrientedPixel> group = thinned(all, kMaxGroupPixels);
  GroupMotion best;
  for (ImageSimilarity motion : starts) {
    for (int l = 1; l >= 0; --l) {
      if (l >= int(current.levels.size()) || current.levels[size_t(l)].edges.pixels.empty()) continue;
      const double width_px = l > 0 ? 6 : 2;
      for (int i = 0; i < kIterations; ++i)
        if (!improve(current.levels[size_t(l)], 1 << l, group, width_px, &motion)) break;
    }
    const double share = agreeing_share(current.finest(), group, motion);
    if (share > best.share) best.motion = motion, best.share = share;
  }
  for (const Eigen::Vector2d& by : {Eigen::Vector2d(kDisplacedPx, kDisplacedPx / 2),
                                    {-kDisplacedPx, 5},
                                    {kDisplacedPx / 2, -kDisplacedPx},
                                    {-5, -kDisplacedPx}}) {
    ImageSimilarity displaced = best.motion;
    displaced.shift += by;
    best.chance += 0.25 * agreeing_share(current.finest(), group, displaced);
  }
  return best;
}

ImageSimilarity then(const ImageSimilarity& first, const ImageSimilarity& second) {
  return {first.centre, second(first(first.centre)) - first.centre, first.scale * second.scale};
}

StaticComparison compare_with_static(const Pinhole& camera, const SE3& T_cur_ref, double median_idepth,
                                     const std::vector<OrientedPixel>& group, const ImageSimilarity& motion) {
  const Eigen::Matrix3d R = T_cur_ref.R();
  const Eigen::Vector3d t = T_cur_ref.translation();
  std::vector<double> distances, own, parallaxes;
  for (const OrientedPixel& p : thinned(group, kMaxGroupPixels)) {
    const Eigen::Vector3d ray = camera.ray(p.px);
    const Projection far = project(camera, R, t, ray, 0), usual = project(camera, R, t, ray, median_idepth);
    if (!far.valid) continue;
    // Its epipolar line, from infinity to the nearest depth, here as far as a linearisation takes it.
    const Projection near = project(camera, R, t, ray, kNearest * median_idepth);
    const Eigen::Vector2d line =
        near.valid ? Eigen::Vector2d(near.px - far.px)
                   : Eigen::Vector2d(kNearest * median_idepth * (projection_jacobian(camera, far.Y) * t));
    const Eigen::Vector2d moved = motion(p.px) - far.px;
    const double along =
        line.squaredNorm() > 0 ? std::clamp(moved.dot(line) / line.squaredNorm(), 0.0, 1.0) : 0.0;
    distances.push_back((moved - along * line).norm());
    own.push_back(along * line.norm());
    if (usual.valid) parallaxes.push_back((usual.px - far.px).norm());
  }
  StaticComparison c;
  if (!distances.empty()) c.distance_px = median(std::move(distances));
  if (!own.empty()) c.own_parallax_px = median(std::move(own));
  if (!parallaxes.empty()) c.parallax_px = median(std::move(parallaxes));
  c.is_fixed = motion.shift.norm() < kFixedPx && std::abs(motion.scale - 1) < kFixedGrowth;
  return c;
}

}  // namespace edgevo
