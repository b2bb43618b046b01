// SPDX-License-Identifier: BSD-3-Clause
#include "view_map.h"

#include <mrpt/opengl/CGridPlaneXY.h>

#include <array>
#include <utility>

#include "edgevo/core/order_statistics.h"
#include "edgevo/core/point_filter.h"

namespace edgevo {
namespace {

constexpr size_t kMaxPoints = 400'000;  // points of the map that a viewer draws smoothly

template <class Object>
typename Object::Ptr insert(mrpt::opengl::COpenGLViewport* viewport) {
  auto object = Object::Create();
  viewport->insert(object);
  return object;
}

mrpt::opengl::CSetOfLines::Ptr insert_lines(mrpt::opengl::COpenGLViewport* viewport,
                                            const mrpt::img::TColor& colour, float width) {
  auto lines = insert<mrpt::opengl::CSetOfLines>(viewport);
  lines->setColor_u8(colour);
  lines->setLineWidth(width);
  return lines;
}

mrpt::opengl::CPointCloudColoured::Ptr insert_points(mrpt::opengl::COpenGLViewport* viewport, float size) {
  auto points = insert<mrpt::opengl::CPointCloudColoured>(viewport);
  points->setPointSize(size);
  return points;
}

void append(const Eigen::Vector3d& a, const Eigen::Vector3d& b, mrpt::opengl::CSetOfLines* lines) {
  lines->appendLine(a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
}

double median_depth_of(const std::vector<SeenPoint>& points) {
  std::vector<float> inverse;
  for (const SeenPoint& p : points) inverse.push_back(p.idepth);
  return inverse.empty() ? 0 : 1.0 / double(median(std::move(inverse)));
}

}  // namespace

ViewMap::ViewMap(const std::optional<SE3>& T_vehicle_cam, std::shared_ptr<MapLog> log,
                 mrpt::opengl::COpenGLViewport* viewport)
    : events_(std::move(log)) {
  Run run;
  run.T_vehicle_cam = T_vehicle_cam;
  T_map_world_ = T_map_world(run);
  map_points_ = insert_points(viewport, 2);
  seen_points_ = insert_points(viewport, 3);
  path_ = insert_lines(viewport, mrpt::img::TColor(250, 90, 60), 3);
  frustum_ = insert_lines(viewport, mrpt::img::TColor(250, 210, 60), 2);
}

void ViewMap::update(const FrameRecord& record, const FrameView& view) {
  const Pinhole& pinhole = view.pyramid->finest().pinhole;
  follow_map(pinhole);
  seen_points_->clear();
  if (!record.T_world_cam_live) return;
  const SE3 T_map_cam = T_map_world_ * *record.T_world_cam_live;
  if (const double depth = median_depth_of(view.points); depth > 0) median_depth_ = depth;
  draw_seen(T_map_cam, view);
  draw_camera(T_map_cam, pinhole);
  if (camera_ && record.segment == segment_) append(*camera_, T_map_cam.translation(), path_.get());
  camera_ = T_map_cam.translation();
  segment_ = record.segment;
}

void ViewMap::follow_map(const Pinhole& pinhole) {
  for (const auto& event : events_.read()) keyframes_.apply(pinhole, *event);
  if (keyframes_.moves() != moves_) {
    moves_ = keyframes_.moves();
    map_points_->clear();
    drawn_ = 0;
  }
  for (; drawn_ < keyframes_.size(); ++drawn_) draw_keyframe(keyframes_.in_live_frame(drawn_), pinhole);
}

// Points have the gray of their images, a little brighter on the dark background.
void ViewMap::draw_keyframe(const KeyframeRecord& keyframe, const Pinhole& pinhole) {
  const PointFilter filter;
  const SE3 T_map_cam = T_map_world_ * keyframe.T_world_cam;
  for (const EdgePoint& p : keyframe.points) {
    if (!filter.keeps(p) || map_points_->size() >= kMaxPoints) continue;
    const Eigen::Vector3f q = (T_map_cam * point_in_camera(pinhole, p)).cast<float>();
    const float gray = 0.35f + 0.65f * float(p.gray) / 255;
    map_points_->push_back(q.x(), q.y(), q.z(), 0.8f * gray, gray, gray);
  }
}

void ViewMap::draw_seen(const SE3& T_map_cam, const FrameView& view) {
  const PointFilter filter;
  for (const SeenPoint& p : view.points) {
    if (p.idepth_sigma > filter.max_relative_sigma * p.idepth) continue;
    const Eigen::Vector3d ray = view.pyramid->finest().pinhole.ray(p.px.cast<double>());
    const Eigen::Vector3f q = (T_map_cam * Eigen::Vector3d(ray / double(p.idepth))).cast<float>();
    seen_points_->push_back(q.x(), q.y(), q.z(), 0.3f, 1.f, 0.4f);
  }
}

void ViewMap::draw_camera(const SE3& T_map_cam, const Pinhole& pinhole) {
  constexpr double kSize = 0.05;  // share of the median depth
  frustum_->clear();
  const double right = pinhole.width - 1, bottom = pinhole.height - 1;
  std::array<Eigen::Vector3d, 4> corners = {pinhole.ray({0, 0}), pinhole.ray({right, 0}),
                                            pinhole.ray({right, bottom}), pinhole.ray({0, bottom})};
  for (Eigen::Vector3d& corner : corners)
    corner = T_map_cam * Eigen::Vector3d(kSize * median_depth_ * corner);
  for (size_t i = 0; i < corners.size(); ++i) {
    append(corners[i], corners[(i + 1) % 4], frustum_.get());
    append(T_map_cam.translation(), corners[i], frustum_.get());
  }
}

}  // namespace edgevo
