// SPDX-License-Identifier: BSD-3-Clause
#include "edge_shapes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace edgevo {
namespace {

// A second's worth that may be saved up: keyframes come in bursts.
constexpr double kMaxSaved_s = 4;
// Share of the depth that a piece may depart from its line: 1.5 pixels of a camera of 60 degrees and 700
// pixels, less than the depth of a vertex is uncertain (edge_map.max_relative_sigma).
constexpr double kMaxDeparture = 0.004;
// Share of a standard deviation that rounding may cost.
constexpr double kRounding = 0.25;

// To a multiple of a power of two: the digits that go are zeros, which compress.
double rounded(double value, double sigma) {
  const double step = std::exp2(std::floor(std::log2(std::max(sigma * kRounding, 1e-6))));
  return std::round(value / step) * step;
}

Eigen::Vector3d rounded(const Eigen::Vector3d& p, double sigma) {
  return p.unaryExpr([sigma](double x) { return rounded(x, sigma); });
}

template <class Point>
double sigma_of(const Point& p, const ShapeView& view) {
  return double(p.idepth_sigma) / (double(p.idepth) * double(p.idepth)) * view.T_map_cam.scale;
}

template <class Point>
RosPoint ros_point(const Point& p, double gray, const ShapeView& view) {
  const double sigma = sigma_of(p, view);
  const Eigen::Vector3d at = view.T_map_cam * point_in_camera(view.pinhole, p);
  return {rounded(at, sigma).cast<float>(), float(gray), float(rounded(sigma, sigma))};
}

RosPoint ros_point(const EdgeVertex& v, const ShapeView& view) {
  return ros_point(v, 0.5 * (v.gray_dark + v.gray_bright), view);
}

double distance_from_line(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double length = along.norm();
  return length > 0 ? (p - a).cross(along).norm() / length : (p - a).norm();
}

// Douglas and Peucker: splits where the line departs most. Appends the indices of the ends but the first.
void simplify(const std::vector<Eigen::Vector3d>& points, size_t first, size_t last, double most,
              std::vector<size_t>* kept) {
  size_t farthest = first;
  double distance = most;
  for (size_t i = first + 1; i < last; ++i)
    if (const double d = distance_from_line(points[i], points[first], points[last]); d > distance)
      farthest = i, distance = d;
  if (farthest == first) return kept->push_back(last);
  simplify(points, first, farthest, most, kept);
  simplify(points, farthest, last, most, kept);
}

std::vector<Eigen::Vector3d> corners_of(const EdgeLine& line, const ShapeView& view) {
  std::vector<Eigen::Vector3d> points;
  double depth = 0, sigma = 0;
  for (const EdgeVertex& v : line.vertices) {
    points.push_back(view.T_map_cam * point_in_camera(view.pinhole, v));
    depth += view.T_map_cam.scale / double(v.idepth), sigma += sigma_of(v, view);
  }
  const double count = double(points.size());
  std::vector<size_t> kept{0};
  if (line.is_straight)
    kept.push_back(points.size() - 1);
  else
    simplify(points, 0, points.size() - 1, std::max(kMaxDeparture * depth, sigma) / count, &kept);
  std::vector<Eigen::Vector3d> corners;
  for (const size_t i : kept) corners.push_back(rounded(points[i], sigma / count));
  return corners;
}

std::vector<const EdgeLine*> longest_first(const std::vector<EdgeLine>& lines) {
  std::vector<const EdgeLine*> sorted;
  for (const EdgeLine& line : lines)
    if (line.vertices.size() >= 2) sorted.push_back(&line);
  std::stable_sort(sorted.begin(), sorted.end(), [](const EdgeLine* a, const EdgeLine* b) {
    return a->vertices.size() > b->vertices.size();
  });
  return sorted;
}

size_t every(size_t count, size_t most) { return most > 0 ? (count + most - 1) / most : count; }

}  // namespace

void Allowance::advance(Timestamp now) {
  if (now_ && *now_ < now)
    left_ = std::min(left_ + per_second_ * seconds_between(*now_, now), kMaxSaved_s * per_second_);
  if (!now_ || *now_ < now) now_ = now;
}

size_t Allowance::take(size_t wanted) {
  const size_t taken = std::min(wanted, size_t(std::max(left_, 0.0)));
  left_ -= double(taken);
  return taken;
}

size_t points_kept(const KeyframeRecord& keyframe, const PointFilter& filter) {
  return size_t(std::count_if(keyframe.points.begin(), keyframe.points.end(),
                              [&](const EdgePoint& p) { return filter.keeps(p); }));
}

std::vector<RosPoint> cloud_of(const KeyframeRecord& keyframe, const ShapeView& view,
                               const PointFilter& filter, size_t most) {
  std::vector<RosPoint> cloud;
  if (most == 0) return cloud;
  const size_t step = every(points_kept(keyframe, filter), most);
  size_t number = 0;
  for (const EdgePoint& p : keyframe.points)
    if (filter.keeps(p) && number++ % step == 0) cloud.push_back(ros_point(p, p.gray, view));
  return cloud;
}

std::vector<Eigen::Vector3d> pieces_of(const std::vector<EdgeLine>& lines, const ShapeView& view,
                                       size_t most) {
  std::vector<Eigen::Vector3d> ends;
  for (const EdgeLine* line : longest_first(lines)) {
    if (ends.size() >= 2 * most) break;
    const std::vector<Eigen::Vector3d> corners = corners_of(*line, view);
    for (size_t i = 1; i < corners.size() && ends.size() < 2 * most; ++i)
      ends.push_back(corners[i - 1]), ends.push_back(corners[i]);
  }
  return ends;
}

std::vector<RosPoint> samples_of(const std::vector<EdgeLine>& lines, const ShapeView& view, size_t most) {
  std::vector<RosPoint> samples;
  size_t count = 0;
  for (const EdgeLine& line : lines) count += line.vertices.size();
  const size_t step = every(count, most);
  for (const EdgeLine* line : longest_first(lines)) {
    if (samples.size() >= most) break;
    const std::vector<EdgeVertex>& v = line->vertices;
    for (size_t i = 0; i < v.size(); i += step) samples.push_back(ros_point(v[i], view));
    if ((v.size() - 1) % step != 0) samples.push_back(ros_point(v.back(), view));
  }
  return samples;
}

}  // namespace edgevo
