// SPDX-License-Identifier: BSD-3-Clause
#include "epipolar_flow.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <opencv2/calib3d.hpp>

#include "edgevo/association/warp.h"

namespace edgevo {
namespace {

constexpr float kMinDeviation = 1.5f;  // gray levels; flatter patches are uninformative
// Points are ordered by cells of this size, so that list neighbours are image neighbours.
constexpr int kNeighbourCellPx = 32;
// Least number of tracks that must agree on an essential matrix: any five fit one.
constexpr int kMinInliers = 20;

struct Track {
  Eigen::Vector2d from;                          // finest level
  Eigen::Vector2d to = Eigen::Vector2d::Zero();  // pixels of the current level
  double correlation = -1;
  Patch patch;  // of the current level
  bool usable = false;
};

double correlation_at(const Patch& patch, const ImageView<uint8_t>& image, const Eigen::Vector2d& px) {
  Patch seen;
  if (!sample_patch(image, px.x(), px.y(), patch.radius, &seen) || normalise(&seen, kMinDeviation) == 0)
    return -1;
  float sum = 0;
  const int n = patch.size();
  for (int i = 0; i < n; ++i) sum += patch.value[i] * seen.value[i];
  return double(sum) / n;
}

void try_at(Track* t, const ImageView<uint8_t>& image, const Eigen::Vector2d& px) {
  const double c = correlation_at(t->patch, image, px);
  if (c > t->correlation) t->correlation = c, t->to = px;
}

void search_square(Track* t, const ImageView<uint8_t>& image, int radius) {
  const Eigen::Vector2d centre = t->to;
  for (int v = -radius; v <= radius; ++v)
    for (int u = -radius; u <= radius; ++u) try_at(t, image, centre + Eigen::Vector2d(u, v));
}

std::vector<Track> make_tracks(const FramePyramid& from, const std::vector<Eigen::Vector2d>& points,
                               int support) {
  std::vector<Track> tracks(points.size());
  for (size_t i = 0; i < points.size(); ++i) tracks[i].from = points[i];
  const auto& edges = from.finest().edges.pixels;
  const size_t count = std::min(size_t(support), edges.size());
  for (size_t i = 0; i < count; ++i) {
    Track t;
    t.from = edges[i * edges.size() / count].position().cast<double>();
    tracks.push_back(t);
  }
  return tracks;
}

std::vector<size_t> order_by_place(const std::vector<Track>& tracks) {
  std::vector<size_t> order(tracks.size());
  std::iota(order.begin(), order.end(), size_t(0));
  const auto key = [&](size_t i) {
    return std::make_pair(int(tracks[i].from.y()) / kNeighbourCellPx,
                          int(tracks[i].from.x()) / kNeighbourCellPx);
  };
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return key(a) < key(b); });
  return order;
}

void cut_patches_at(const PyramidLevel& level, double scale, int radius, std::vector<Track>* tracks) {
  for (Track& t : *tracks) {
    const Eigen::Vector2d px = scale * t.from;
    t.usable = sample_patch(level.gray.view(), px.x(), px.y(), radius, &t.patch) &&
               normalise(&t.patch, kMinDeviation) > 0;
    t.correlation = -1;
  }
}

// Each track tries the flow of its neighbours, forwards and backwards.
template <class Propose>
void spread(const std::vector<size_t>& order, const Propose& propose) {
  for (size_t k = 1; k < order.size(); ++k) propose(order[k], order[k - 1]);
  for (size_t k = order.size() - 1; k > 0; --k) propose(order[k - 1], order[k]);
}

// Two-dimensional flow, coarse to fine, down to the finest level.
void estimate_flow(const FramePyramid& from, const FramePyramid& to, const EpipolarFlowParams& params,
                   const std::vector<size_t>& order, std::vector<Track>* tracks) {
  const int coarsest = int(from.levels.size()) - 1;
  for (int level = coarsest; level >= 0; --level) {
    const double scale = std::ldexp(1.0, -level);
    const ImageView<uint8_t> image = to.levels[size_t(level)].gray.view();
    cut_patches_at(from.levels[size_t(level)], scale, params.patch_radius, tracks);
    for (Track& t : *tracks) {
      t.to = level == coarsest ? Eigen::Vector2d(scale * t.from) : Eigen::Vector2d(2 * t.to);
      if (t.usable) search_square(&t, image, level == coarsest ? params.coarse_radius : 1);
    }
    spread(order, [&](size_t i, size_t neighbour) {
      Track& t = (*tracks)[i];
      const Track& n = (*tracks)[neighbour];
      if (!t.usable || n.correlation < params.min_correlation) return;
      const double before = t.correlation;
      try_at(&t, image, scale * (t.from - n.from) + n.to);
      if (t.correlation > before) search_square(&t, image, 1);
    });
  }
}

bool estimate_geometry(const Pinhole& camera, const std::vector<Track>& tracks,
                       const EpipolarFlowParams& params, Eigen::Matrix3d* F) {
  std::vector<cv::Point2d> first, last;
  for (const Track& t : tracks) {
    if (!t.usable || t.correlation < params.min_correlation) continue;
    first.emplace_back(t.from.x(), t.from.y());
    last.emplace_back(t.to.x(), t.to.y());
  }
  if (int(first.size()) < kMinInliers) return false;
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  cv::Mat inliers;
  const cv::Mat E = cv::findEssentialMat(first, last, K, cv::RANSAC, 0.999, params.ransac_px, inliers);
  if (E.rows != 3 || E.cols != 3 || cv::countNonZero(inliers) < kMinInliers) return false;
  Eigen::Matrix3d K_inverse = Eigen::Matrix3d::Zero(), essential;
  for (int i = 0; i < 9; ++i) essential(i / 3, i % 3) = E.at<double>(i / 3, i % 3);
  K_inverse << 1 / camera.fx, 0, -camera.cx / camera.fx, 0, 1 / camera.fy, -camera.cy / camera.fy, 0, 0, 1;
  *F = K_inverse.transpose() * essential * K_inverse;
  return true;
}

// The epipolar line of a point: positions foot + s direction.
struct Line {
  Eigen::Vector2d normal, direction;
  double offset;  // normal^T px + offset = 0
  Eigen::Vector2d project(const Eigen::Vector2d& px) const { return px - (normal.dot(px) + offset) * normal; }
};

Line line_of(const Eigen::Matrix3d& F, const Eigen::Vector2d& px) {
  const Eigen::Vector3d l = F * px.homogeneous();
  const double length = std::max(l.head<2>().norm(), 1e-12);
  const Eigen::Vector2d normal = l.head<2>() / length;
  return {normal, {-normal.y(), normal.x()}, l.z() / length};
}

void search_line(Track* t, const Line& line, const ImageView<uint8_t>& image, const Eigen::Vector2d& about,
                 int radius) {
  const Eigen::Vector2d centre = line.project(about);
  for (int s = -radius; s <= radius; ++s) try_at(t, image, centre + s * line.direction);
}

// Sub-pixel along the line by a parabola through three correlations.
void refine_on_line(Track* t, const Line& line, const ImageView<uint8_t>& image) {
  const double a = correlation_at(t->patch, image, t->to - line.direction),
               b = correlation_at(t->patch, image, t->to + line.direction);
  const double curvature = a - 2 * t->correlation + b;
  if (a > -1 && b > -1 && curvature < -1e-6)
    t->to += std::clamp(0.5 * (a - b) / curvature, -0.5, 0.5) * line.direction;
}

void search_lines(const FramePyramid& to, const EpipolarFlowParams& params, const Eigen::Matrix3d& F,
                  const std::vector<size_t>& order, std::vector<Track>* tracks) {
  const ImageView<uint8_t> image = to.finest().gray.view();
  std::vector<Line> lines;
  for (Track& t : *tracks) {
    lines.push_back(line_of(F, t.from));
    t.correlation = -1;
    if (t.usable) search_line(&t, lines.back(), image, t.to, params.line_radius);
  }
  spread(order, [&](size_t i, size_t neighbour) {
    Track& t = (*tracks)[i];
    const Track& n = (*tracks)[neighbour];
    if (t.usable && n.correlation >= params.min_correlation && t.correlation < n.correlation)
      search_line(&t, lines[i], image, t.from + n.to - n.from, 1);
  });
  for (size_t i = 0; i < tracks->size(); ++i)
    if ((*tracks)[i].usable) refine_on_line(&(*tracks)[i], lines[i], image);
}

}  // namespace

std::vector<FlowMatch> epipolar_flow(const FramePyramid& from, const FramePyramid& to,
                                     const std::vector<Eigen::Vector2d>& points,
                                     const EpipolarFlowParams& params) {
  std::vector<FlowMatch> matches(points.size());
  std::vector<Track> tracks = make_tracks(from, points, params.support_points);
  const std::vector<size_t> order = order_by_place(tracks);
  if (order.empty()) return matches;
  estimate_flow(from, to, params, order, &tracks);
  Eigen::Matrix3d F;
  if (!estimate_geometry(from.finest().pinhole, tracks, params, &F)) return matches;
  search_lines(to, params, F, order, &tracks);
  for (size_t i = 0; i < points.size(); ++i)
    matches[i] = {tracks[i].usable && tracks[i].correlation >= params.min_correlation, tracks[i].to,
                  tracks[i].correlation};
  return matches;
}

}  // namespace edgevo
