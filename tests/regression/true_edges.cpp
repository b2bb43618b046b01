// SPDX-License-Identifier: BSD-3-Clause
#include "true_edges.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "edgevo/core/point_filter.h"
#include "edgevo/edges/frame_pyramid.h"
#include "edgevo/simulation/correspondence.h"

namespace edgevo::test {
namespace {

constexpr int kMinKeyframes = 3;

using Points = std::vector<Eigen::Vector3d>;

Eigen::Matrix4d fit(const Points& from, const Points& to, bool with_scale) {
  Eigen::Matrix3Xd a(3, from.size()), b(3, to.size());
  for (size_t i = 0; i < from.size(); ++i) a.col(Eigen::Index(i)) = from[i], b.col(Eigen::Index(i)) = to[i];
  return Eigen::umeyama(a, b, with_scale);
}

// Lays the path of the run onto the true one: scale, then motion. A straight path leaves the roll
// undetermined; a second point a metre above each camera fixes it.
void fit_path(const Scene& scene, const Run& run, double* scale, SE3* T_scene_run) {
  Points from, to;
  for (const FrameRecord& f : run.frames) {
    if (!f.T_world_cam) continue;
    from.push_back(f.T_world_cam->translation());
    to.push_back(scene.T_scene_cam[size_t(f.index)].translation());
  }
  *scale = fit(from, to, true).topLeftCorner<3, 3>().col(0).norm();
  const Eigen::Vector3d up(0, -1, 0);
  for (Eigen::Vector3d& p : from) p *= *scale;
  for (const FrameRecord& f : run.frames) {
    if (!f.T_world_cam) continue;
    from.push_back(*scale * f.T_world_cam->translation() + f.T_world_cam->R() * up);
    to.push_back(scene.T_scene_cam[size_t(f.index)] * up);
  }
  const Eigen::Matrix4d T = fit(from, to, false);
  *T_scene_run = SE3(Eigen::Matrix3d(T.topLeftCorner<3, 3>()), Eigen::Vector3d(T.topRightCorner<3, 1>()));
}

double share_of(int64_t part, int64_t all) { return double(part) / double(std::max<int64_t>(1, all)); }

}  // namespace

std::ostream& operator<<(std::ostream& out, const EdgeMapQuality& q) {
  return out << 100 * q.completeness << " % of " << q.true_cells << " cells of true edges reconstructed, "
             << 100 * q.accuracy << " % of " << q.length
             << " m of lines at true edges (points alone: " << 100 * q.points_completeness << ", "
             << 100 * q.points_accuracy << " %; both: " << 100 * q.both_completeness << " %); " << q.lines
             << " lines with " << q.vertices << " vertices in " << q.keyframes << " keyframes";
}

TrueEdges::TrueEdges(const SceneRenderer& renderer, const Run& run, double range, double tolerance)
    : renderer_(&renderer), range_(range), tolerance_(tolerance) {
  fit_path(renderer.scene(), run, &scale_, &T_scene_run_);
  pixels_.resize(run.keyframes.size());
  for (size_t k = 0; k < run.keyframes.size(); ++k) add_edges(int(k), run.keyframes[k].frame_index);
}

TrueEdges::Cell TrueEdges::cell_of(const Eigen::Vector3d& p) const {
  const double side = 0.5 * tolerance_;
  return {int(std::floor(p.x() / side)), int(std::floor(p.y() / side)), int(std::floor(p.z() / side))};
}

void TrueEdges::add_edges(int keyframe, int frame_index) {
  const RenderedFrame frame = renderer_->render(frame_index);
  PyramidBuilder builder(renderer_->camera(), EdgeParams());
  const Pinhole pinhole = renderer_->camera().pinhole();
  const ImageView<float> depth{frame.depth.data(), pinhole.width, pinhole.height, pinhole.width};
  const SE3& T_scene_cam = renderer_->scene().T_scene_cam[size_t(frame_index)];
  const auto pyramid = builder.build(frame.image);
  for (const EdgePixel& e : pyramid->finest().edges.pixels) {
    const Eigen::Vector2d px = e.position().cast<double>();
    const double idepth = edge_idepth(depth, px);
    if (!(idepth > 0)) continue;
    const Eigen::Vector3d p_cam = pinhole.ray(px) / idepth;
    if (p_cam.norm() > range_) continue;
    const Eigen::Vector3d p = T_scene_cam * p_cam;
    const Cell cell = cell_of(p);
    pixels_[size_t(keyframe)].push_back({e.position(), e.normal(), p_cam, cell});
    Seen& seen = seen_[cell];
    seen.sum += p, ++seen.pixels;
    seen.keyframes += std::exchange(seen.last_keyframe, keyframe) != keyframe;
  }
}

bool TrueEdges::is_counted(const Cell& cell) const { return seen_.at(cell).keyframes >= kMinKeyframes; }

TrueEdges::Cells TrueEdges::cells_of_lines(const Run& run) const {
  Cells lines;
  EdgeMapQuality quality;
  evaluate_lines(run, &lines, &quality);
  return lines;
}

// Within the tolerance of the mean of a cell; cells are half as long.
bool TrueEdges::has_near(const Cells& cells, const Eigen::Vector3d& p) const {
  const Cell c = cell_of(p);
  for (int dx = -2; dx <= 2; ++dx)
    for (int dy = -2; dy <= 2; ++dy)
      for (int dz = -2; dz <= 2; ++dz) {
        const auto at = cells.find({c[0] + dx, c[1] + dy, c[2] + dz});
        if (at != cells.end() && (at->second.mean() - p).norm() <= tolerance_) return true;
      }
  return false;
}

Eigen::Vector3d TrueEdges::in_scene(const KeyframeRecord& k, const Eigen::Vector3d& p_cam) const {
  return T_scene_run_ * (scale_ * (k.T_world_cam * p_cam));
}

void TrueEdges::add(const Eigen::Vector3d& p, Cells* cells) const {
  Seen& s = (*cells)[cell_of(p)];
  s.sum += p, ++s.pixels;
}

void TrueEdges::evaluate_points(const Run& run, Cells* points, EdgeMapQuality* q) const {
  const PointFilter filter;
  int64_t kept = 0, good = 0;
  for (const KeyframeRecord& k : run.keyframes)
    for (const EdgePoint& e : k.points) {
      const Eigen::Vector3d p_cam = point_in_camera(run.pinhole, e);
      if (!filter.keeps(e) || scale_ * p_cam.norm() > range_) continue;
      const Eigen::Vector3d p = in_scene(k, p_cam);
      ++kept, good += has_near(seen_, p);
      add(p, points);
    }
  q->points_accuracy = share_of(good, kept);
}

void TrueEdges::evaluate_lines(const Run& run, Cells* lines, EdgeMapQuality* q) const {
  double good = 0;
  for (const KeyframeRecord& k : run.keyframes)
    for (const EdgeLine& line : k.lines) {
      ++q->lines, q->vertices += int64_t(line.vertices.size());
      for (size_t i = 1; i < line.vertices.size(); ++i) {
        const Eigen::Vector3d a_cam = point_in_camera(run.pinhole, line.vertices[i - 1]);
        const Eigen::Vector3d b_cam = point_in_camera(run.pinhole, line.vertices[i]);
        if (scale_ * std::max(a_cam.norm(), b_cam.norm()) > range_) continue;
        const Eigen::Vector3d a = in_scene(k, a_cam), b = in_scene(k, b_cam);
        const double length = (b - a).norm();
        q->length += length;
        good += length * has_near(seen_, 0.5 * (a + b));
        const int steps = 1 + int(length / (0.5 * tolerance_));
        for (int s = 0; s <= steps; ++s) add(a + (b - a) * s / steps, lines);
      }
    }
  q->accuracy = q->length > 0 ? good / q->length : 0;
}

EdgeMapQuality TrueEdges::evaluate(const Run& run) const {
  EdgeMapQuality q;
  q.keyframes = int64_t(run.keyframes.size());
  Cells lines, points;
  evaluate_points(run, &points, &q);
  evaluate_lines(run, &lines, &q);
  int64_t by_lines = 0, by_points = 0, by_both = 0;
  for (const auto& [cell, seen] : seen_) {
    if (!is_counted(cell)) continue;
    ++q.true_cells;
    const bool on_line = has_near(lines, seen.mean()), on_point = has_near(points, seen.mean());
    by_lines += on_line, by_points += on_point, by_both += on_line || on_point;
  }
  q.completeness = share_of(by_lines, q.true_cells);
  q.points_completeness = share_of(by_points, q.true_cells);
  q.both_completeness = share_of(by_both, q.true_cells);
  return q;
}

}  // namespace edgevo::test
