// SPDX-License-Identifier: BSD-3-Clause
#include "true_view.h"

#include <cmath>

#include "edgevo/simulation/correspondence.h"

namespace edgevo {
namespace {

// Sine of the angle between edge and epipolar line, below which a depth is not to be had from views: that at
// which the depth filter does not search (14.5 degrees).
constexpr double kAlongSine = 0.25;
constexpr double kNextPx = 1.5;         // from an edge to the pixels of the surfaces that it belongs to
constexpr double kGroundHeight = 0.3;   // metres: a wheel, or a foot, is stopped by what is higher
constexpr double kUprightSine = 0.174;  // of the angle to the vertical in the image: 10 degrees

// Calls `f` with the pixels within `reach` of `px` until it returns true.
template <class F>
bool any_pixel_near(const Pinhole& p, const Eigen::Vector2d& px, double reach, const F& f) {
  const int x0 = std::max(0, int(std::ceil(px.x() - reach))),
            y0 = std::max(0, int(std::ceil(px.y() - reach)));
  const int x1 = std::min(p.width - 1, int(std::floor(px.x() + reach)));
  const int y1 = std::min(p.height - 1, int(std::floor(px.y() + reach)));
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x)
      if ((Eigen::Vector2d(x, y) - px).squaredNorm() <= reach * reach && f(size_t(y * p.width + x)))
        return true;
  return false;
}

bool is_along(const Pinhole& p, const Eigen::Vector2d& px, const Eigen::Vector2d& normal, double depth,
              const SE3& T_before_cam) {
  const Eigen::Vector3d ray = p.ray(px), there = T_before_cam * (depth * ray),
                        far = T_before_cam * (2 * depth * ray);
  if (there.z() <= 0 || far.z() <= 0) return false;
  // The epipolar line in this image: through the pixel and the place of the camera before.
  const Eigen::Vector3d camera = T_before_cam.inverse().translation();
  const Eigen::Vector2d towards(p.fx * (camera.x() - ray.x() * camera.z()),
                                p.fy * (camera.y() - ray.y() * camera.z()));
  return towards.norm() > 0 && std::abs(normal.dot(towards)) < kAlongSine * towards.norm();
}

// A point three pixels on; at a jump in depth, as far away as the edge.
Eigen::Vector3d next_on_edge(const ImageView<float>& depth, const Pinhole& p, const TrueEdgePixel& e) {
  constexpr double kStepPx = 3, kJump = 0.1;
  const Eigen::Vector2d px = e.px + kStepPx * Eigen::Vector2d(-e.normal.y(), e.normal.x());
  const double there = 1 / edge_idepth(depth, px);
  return (std::abs(there - e.depth) < kJump * e.depth ? there : e.depth) * p.ray(px);
}

}  // namespace

TrueView::TrueView(const SceneRenderer& scene, PyramidBuilder* builder, int index, int before)
    : pinhole_(builder->pinhole()), T_scene_cam_(scene.scene().T_scene_cam[size_t(index)]) {
  RenderedFrame frame = scene.render(index);
  depth_ = std::move(frame.depth);
  labels_ = true_edge_labels(scene, index), things_ = scene.render_things(index);
  edge_depth_.resize(depth_.size());
  const auto pyramid = builder->build(frame.image);
  const Plane<uint8_t>& gray = pyramid->finest().gray;
  image_ = {pinhole_.width, pinhole_.height, {}};
  for (int y = 0; y < pinhole_.height; ++y)
    image_.pixels.insert(image_.pixels.end(), gray.row(y), gray.row(y) + pinhole_.width);
  add_edges(pyramid->finest(), scene.scene().T_scene_cam[size_t(before)].inverse() * T_scene_cam_);
  add_faint_edges();
}

void TrueView::add_edges(const PyramidLevel& level, const SE3& T_before_cam) {
  const ImageView<float> depth{depth_.data(), pinhole_.width, pinhole_.height, pinhole_.width};
  for (const EdgePixel& e : level.edges.pixels) {
    TrueEdgePixel t;
    t.px = e.position().cast<double>(), t.normal = e.normal().cast<double>();
    const double idepth = edge_idepth(depth, t.px);
    if (!(idepth > 0)) continue;
    t.depth = 1 / idepth;
    any_pixel_near(pinhole_, t.px, kNextPx, [&](size_t i) {
      t.kind = std::max(t.kind, TrueEdge(labels_.pixels[i]));
      return false;
    });
    t.thing = thing_of(t), t.next = next_on_edge(depth, pinhole_, t);
    t.length_px = level.edges.chains[size_t(e.chain)].length();
    t.is_along_motion = is_along(pinhole_, t.px, t.normal, t.depth, T_before_cam);
    const size_t at = size_t(std::lround(t.px.y()) * pinhole_.width + std::lround(t.px.x()));
    edge_depth_[at] = float(t.depth);
    edges_.push_back(t);
  }
}

// Of the surfaces that meet in it, the first in the order of Thing.
Thing TrueView::thing_of(const TrueEdgePixel& edge) const {
  constexpr double kMeets = 0.02;  // of the depth, between surfaces that touch
  uint8_t first = kNoThing;
  any_pixel_near(pinhole_, edge.px, kNextPx, [&](size_t i) {
    if (std::abs(double(depth_[i]) - edge.depth) <= kMeets * edge.depth)
      first = std::min(first, things_.pixels[i]);
    return false;
  });
  return first == kNoThing ? Thing::kObject : Thing(first);
}

void TrueView::add_faint_edges() {
  const ImageView<float> depth{depth_.data(), pinhole_.width, pinhole_.height, pinhole_.width};
  for (int y = 0; y < pinhole_.height; ++y)
    for (int x = 0; x < pinhole_.width; ++x) {
      float& there = edge_depth_[size_t(y * pinhole_.width + x)];
      if (there > 0 || labels_.pixels[size_t(y * pinhole_.width + x)] == 0) continue;
      const double idepth = edge_idepth(depth, {double(x), double(y)});
      if (idepth > 0) there = float(1 / idepth);
    }
}

EdgePlace TrueView::place_of(const Eigen::Vector2d& px, const Eigen::Vector2d& normal, double depth) const {
  const Eigen::Vector3d at = depth * pinhole_.ray(px);
  if ((T_scene_cam_ * at).z() < kGroundHeight) return EdgePlace::kOnGround;
  const Eigen::Vector3d up = T_scene_cam_.R().row(2).transpose();
  // The image of the vertical through the point.
  const Eigen::Vector2d vertical(pinhole_.fx * (up.x() * at.z() - at.x() * up.z()),
                                 pinhole_.fy * (up.y() * at.z() - at.y() * up.z()));
  return std::abs(normal.dot(vertical)) < kUprightSine * vertical.norm() ? EdgePlace::kUpright
                                                                         : EdgePlace::kAbove;
}

bool TrueView::is_hidden(const Eigen::Vector2d& px, double depth, double reach, double share) const {
  return !any_pixel_near(pinhole_, px, reach, [&](size_t i) {
    return !(depth_[i] > 0) || depth <= (1 + share) * double(depth_[i]);
  });
}

bool TrueView::has_edge(const Eigen::Vector2d& px, double depth, double reach, double share) const {
  return any_pixel_near(pinhole_, px, reach, [&](size_t i) {
    return edge_depth_[i] > 0 && std::abs(double(edge_depth_[i]) - depth) <= share * double(edge_depth_[i]);
  });
}

}  // namespace edgevo
