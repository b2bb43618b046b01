// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mrpt_bridge/scene_writer.h"

#include <mrpt/img/color_maps.h>
#include <mrpt/opengl/CGridPlaneXY.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CPointCloudColoured.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/stock_objects.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "edgevo/core/order_statistics.h"
#include "object_file.h"

namespace edgevo {
namespace {

using Points = std::vector<Eigen::Vector3f>;

constexpr std::array<std::array<uint8_t, 3>, 5> kSegmentColours = {
    {{230, 60, 40}, {40, 120, 230}, {40, 170, 80}, {200, 120, 20}, {150, 60, 190}}};

mrpt::img::TColor segment_colour(int segment) {
  const auto& c = kSegmentColours[size_t(std::max(segment, 0)) % kSegmentColours.size()];
  return {c[0], c[1], c[2]};
}

void append_line(const Eigen::Vector3d& a, const Eigen::Vector3d& b, mrpt::opengl::CSetOfLines* lines) {
  lines->appendLine(a.x(), a.y(), a.z(), b.x(), b.y(), b.z());
}

mrpt::opengl::CSetOfLines::Ptr make_lines(const mrpt::img::TColor& colour, float width,
                                          const std::string& name) {
  auto lines = mrpt::opengl::CSetOfLines::Create();
  lines->setColor_u8(colour);
  lines->setLineWidth(width);
  lines->setName(name);
  return lines;
}

void add_trajectory(const Run& run, mrpt::opengl::COpenGLScene* scene) {
  const SE3 T_map = T_map_world(run);
  std::map<int, std::vector<Eigen::Vector3d>> by_segment;
  for (const FrameRecord& frame : run.frames)
    if (frame.T_world_cam && frame.T_world_cam->is_finite())
      by_segment[frame.segment].push_back(T_map * frame.T_world_cam->translation());
  for (const auto& [segment, positions] : by_segment) {
    auto lines = make_lines(segment_colour(segment), 2, "trajectory " + std::to_string(segment));
    for (size_t i = 1; i < positions.size(); ++i) append_line(positions[i - 1], positions[i], lines.get());
    scene->insert(lines);
  }
}

// The frame of a camera's image at the distance `size`, and the four edges to it.
void append_frustum(const SE3& T_map_cam, const Pinhole& pinhole, double size,
                    mrpt::opengl::CSetOfLines* lines) {
  const double right = pinhole.width - 1, bottom = pinhole.height - 1;
  std::array<Eigen::Vector3d, 4> corners = {pinhole.ray({0, 0}), pinhole.ray({right, 0}),
                                            pinhole.ray({right, bottom}), pinhole.ray({0, bottom})};
  for (Eigen::Vector3d& corner : corners) corner = T_map_cam * Eigen::Vector3d(size * corner);
  for (size_t i = 0; i < 4; ++i) {
    append_line(corners[i], corners[(i + 1) % 4], lines);
    append_line(T_map_cam.translation(), corners[i], lines);
  }
}

void add_frusta(const Run& run, double size, mrpt::opengl::COpenGLScene* scene) {
  const SE3 T_map = T_map_world(run);
  auto lines = make_lines(mrpt::img::TColor(250, 210, 60), 1, "keyframes");
  for (const KeyframeRecord& keyframe : run.keyframes)
    if (keyframe.T_world_cam.is_finite())
      append_frustum(T_map * keyframe.T_world_cam, run.pinhole, size, lines.get());
  scene->insert(lines);
}

struct Cloud {
  /// World of the map files.
  Points points;
  /// Frame of the host camera.
  std::vector<float> depth;
};

Cloud gather(const Run& run, const PointFilter& filter, int max_points) {
  const SE3 T_map = T_map_world(run);
  const int kept = count_points(run, filter).kept;
  const int step = std::max(1, (kept + max_points - 1) / max_points);
  Cloud cloud;
  int n = 0;
  for (const KeyframeRecord& keyframe : run.keyframes) {
    const SE3 T_map_cam = T_map * keyframe.T_world_cam;
    if (!T_map_cam.is_finite()) continue;
    for (const EdgePoint& p : keyframe.points) {
      if (!filter.keeps(p) || n++ % step != 0) continue;
      cloud.points.push_back((T_map_cam * point_in_camera(run.pinhole, p)).cast<float>());
      cloud.depth.push_back(1 / p.idepth);
    }
  }
  return cloud;
}

// Colours of heights, from the 5th percentile of the points to the 95th.
class HeightColours {
 public:
  explicit HeightColours(const Cloud& cloud) {
    std::vector<float> heights;
    for (const auto& p : cloud.points) heights.push_back(p.z());
    low_ = quantile(heights, 0.05);
    span_ = std::max(quantile(heights, 0.95) - low_, 1e-6f);
  }
  float share(float height) const { return std::clamp((height - low_) / span_, 0.f, 1.f); }
  /// Not from 0: the darkest blue is invisible on the gray of the viewers.
  static mrpt::img::TColorf colour(float share) {
    mrpt::img::TColorf c;
    mrpt::img::colormap(mrpt::img::cmJET, 0.15f + 0.85f * share, c.R, c.G, c.B);
    return c;
  }

 private:
  float low_ = 0, span_ = 1;
};

// A set of lines has one colour: one set for each band of heights.
void add_edge_lines(const Run& run, const HeightColours& colours, mrpt::opengl::COpenGLScene* scene) {
  constexpr int kBands = 16;
  const SE3 T_map = T_map_world(run);
  std::vector<mrpt::opengl::CSetOfLines::Ptr> bands;
  for (int b = 0; b < kBands; ++b)
    bands.push_back(make_lines(HeightColours::colour((float(b) + 0.5f) / kBands).asTColor(), 1,
                               "edge lines " + std::to_string(b)));
  for (const KeyframeRecord& k : run.keyframes) {
    const SE3 T_map_cam = T_map * k.T_world_cam;
    if (!T_map_cam.is_finite()) continue;
    for (const EdgeLine& line : k.lines)
      for (size_t i = 1; i < line.vertices.size(); ++i) {
        const Eigen::Vector3d a = T_map_cam * point_in_camera(run.pinhole, line.vertices[i - 1]);
        const Eigen::Vector3d b = T_map_cam * point_in_camera(run.pinhole, line.vertices[i]);
        const int band = std::min(kBands - 1, int(kBands * colours.share(float(0.5 * (a.z() + b.z())))));
        append_line(a, b, bands[size_t(band)].get());
      }
  }
  for (const auto& band : bands)
    if (band->getLineCount() > 0) scene->insert(band);
}

void add_cloud(const Cloud& cloud, const HeightColours& colours, mrpt::opengl::COpenGLScene* scene) {
  auto object = mrpt::opengl::CPointCloudColoured::Create();
  object->setName("edges");
  object->setPointSize(2);
  for (const auto& p : cloud.points) {
    const mrpt::img::TColorf c = HeightColours::colour(colours.share(p.z()));
    object->push_back(p.x(), p.y(), p.z(), c.R, c.G, c.B);
  }
  scene->insert(object);
}

// The box around the path and nine tenths of the edges along each axis, which ignores distant outliers.
struct Extent {
  Eigen::Vector3f low{-1, -1, -1}, high{1, 1, 1};

  Eigen::Vector3f centre() const { return 0.5f * (low + high); }
  float width() const { return std::max({high.x() - low.x(), high.y() - low.y(), 1e-6f}); }
};

Extent extent_of(const Cloud& cloud, const Run& run) {
  Points path;
  const SE3 T_map = T_map_world(run);
  for (const FrameRecord& f : run.frames)
    if (f.T_world_cam && f.T_world_cam->is_finite())
      path.push_back((T_map * f.T_world_cam->translation()).cast<float>());
  Extent e;
  for (int axis = 0; axis < 3 && !path.empty(); ++axis) {
    std::vector<float> along, edges;
    for (const auto& p : path) along.push_back(p[axis]);
    for (const auto& p : cloud.points) edges.push_back(p[axis]);
    if (!edges.empty()) along.insert(along.end(), {quantile(edges, 0.05), quantile(edges, 0.95)});
    e.low[axis] = *std::min_element(along.begin(), along.end());
    e.high[axis] = *std::max_element(along.begin(), along.end());
  }
  return e;
}

// Grid lines a power of ten apart, ten to a hundred over the width of the scene.
void add_ground(const Extent& extent, mrpt::opengl::COpenGLScene* scene) {
  const float step = std::pow(10.f, std::floor(std::log10(extent.width())) - 1);
  const auto outward = [&](float from, float to) {
    return step * (to > from ? std::ceil(to / step) : std::floor(to / step));
  };
  const Eigen::Vector3f c = extent.centre();
  auto grid = mrpt::opengl::CGridPlaneXY::Create(
      outward(c.x(), extent.low.x()), outward(c.x(), extent.high.x()), outward(c.y(), extent.low.y()),
      outward(c.y(), extent.high.y()), 0, step);
  grid->setColor_u8(mrpt::img::TColor(200, 200, 200));
  scene->insert(grid);
  scene->insert(mrpt::opengl::stock_objects::CornerXYZSimple(step));
}

// The camera of the main viewport views the whole scene from above and behind the start. SceneViewer3D adopts
// it only if the scene requests that.
void look_at(const Extent& extent, mrpt::opengl::COpenGLScene* scene) {
  const Eigen::Vector3f c = extent.centre();
  mrpt::opengl::CCamera& camera = scene->getViewport()->getCamera();
  camera.setPointingAt(c.x(), c.y(), c.z());
  camera.setZoomDistance(1.5f * extent.width());
  camera.setAzimuthDegrees(-150);
  camera.setElevationDegrees(40);
  scene->enableFollowCamera(true);
}

}  // namespace

void write_scene(const Run& run, const PointFilter& filter, const std::string& path,
                 const SceneOptions& options) {
  // Frusta of a twentieth of the median depth are distinguishable in most maps and do not hide the edges.
  constexpr float kFrustumShare = 0.05f;
  const Cloud cloud = gather(run, filter, std::max(options.max_points, 1));
  mrpt::opengl::COpenGLScene scene;
  const Extent extent = extent_of(cloud, run);
  add_ground(extent, &scene);
  look_at(extent, &scene);
  const HeightColours colours(cloud);
  add_cloud(cloud, colours, &scene);
  add_edge_lines(run, colours, &scene);
  add_trajectory(run, &scene);
  const float depth = quantile(cloud.depth, 0.5);
  add_frusta(run, double(depth > 0 ? kFrustumShare * depth : kFrustumShare), &scene);
  ObjectFile out(path);
  out.write(scene);
  out.close();
}

}  // namespace edgevo
