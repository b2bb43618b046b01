// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/simulation/true_edge_labels.h"

#include <algorithm>
#include <cmath>

#include "active_surfaces.h"
#include "image_pass.h"
#include "visibility.h"

namespace edgevo {
namespace {

// An undistorted view of the scene.
struct Look {
  Scene scene;
  Instant at;
  int width() const { return scene.camera.pinhole().width; }
  int height() const { return scene.camera.pinhole().height; }
};

Look look_of(const SceneRenderer& renderer, int index) {
  Look look{renderer.scene(), instant_of(renderer.scene(), index)};
  look.scene.camera = Camera(renderer.undistorted());
  return look;
}

// Kind of edge between two planes of one pixel. The line at which their depths are equal is (N_a - N_b).d =
// 0.
TrueEdge kind_between(const Eigen::Vector3d& N_a, const Eigen::Vector3d& N_b, const Pinhole& p,
                      const Eigen::Vector2d& px) {
  constexpr double kSamePlane = 1e-7;  // of 1/z: what rounding leaves between surfaces of one plane
  // Pixels: the line passes through the square, whose corners are 0.71 away, or close by.
  constexpr double kMeets = 1.0;
  const Eigen::Vector3d d = p.ray(px), step = N_a - N_b;
  const double idepth = std::max(N_a.dot(d), N_b.dot(d)), difference = std::abs(step.dot(d));
  const double slope = std::hypot(step.x() / p.fx, step.y() / p.fy);
  if (difference <= kSamePlane * idepth && slope <= kSamePlane * idepth) return TrueEdge::none;
  return difference <= kMeets * slope ? TrueEdge::crease : TrueEdge::depth_step;
}

TrueEdge kind_of_pair(int a, int b, const std::vector<ViewSurface>& views, const Pinhole& p,
                      const Eigen::Vector2d& px) {
  if (a < 0 || b < 0) return TrueEdge::depth_step;  // the sky
  return kind_between(views[size_t(a)].idepth, views[size_t(b)].idepth, p, px);
}

// The strongest kind among the surfaces that the nine points of a pixel meet.
TrueEdge kind_of_pixel(RowSamples& row, int u, int v, const std::vector<ViewSurface>& views,
                       const Pinhole& p) {
  TrueEdge kind = TrueEdge::none;
  for (int s = 1; s < kSamples; ++s)
    for (int t = row.owner_of(s)[u] == row.owner_of(0)[u] ? s : 0; t < s; ++t) {
      const int a = row.owner_of(s)[u], b = row.owner_of(t)[u];
      if (a != b) kind = std::max(kind, kind_of_pair(a, b, views, p, {double(u), double(v)}));
    }
  return kind;
}

// The surfaces that the centres of all pixels meet.
struct Owners {
  int width;
  std::vector<int32_t> ids;
  int32_t at(int u, int v) const { return ids[size_t(v) * size_t(width) + size_t(u)]; }
};

// A line exactly between two pixels also passes between their points: the first of them is marked.
void mark_between(const Owners& owners, const std::vector<ViewSurface>& views, const Pinhole& p,
                  GrayImage* labels) {
  const auto label = [&](int u, int v) -> uint8_t& {
    return labels->pixels[size_t(v) * size_t(p.width) + size_t(u)];
  };
  const auto mark = [&](int u, int v, int u_next, int v_next) {
    if (u_next >= p.width || v_next >= p.height || owners.at(u, v) == owners.at(u_next, v_next)) return;
    if (label(u, v) != 0 || label(u_next, v_next) != 0) return;
    label(u, v) =
        uint8_t(kind_of_pair(owners.at(u, v), owners.at(u_next, v_next), views, p, {double(u), double(v)}));
  };
  for (int v = 0; v < p.height; ++v)
    for (int u = 0; u < p.width; ++u) mark(u, v, u + 1, v), mark(u, v, u, v + 1);
}

// Depth steps and creases.
GrayImage geometric_labels(const Look& look) {
  const Pinhole p = look.scene.camera.pinhole();
  const std::vector<ViewSurface> views =
      view_scene(look.scene, look.scene.camera, look.at, {0, p.height}).surfaces;
  RowSamples row(p.width, kSamples);
  set_sample_columns(p, kSamples, &row);
  ActiveSurfaces active(views);
  GrayImage labels{p.width, p.height, {}};
  Owners owners{p.width, {}};
  for (int v = 0; v < p.height; ++v) {
    row.clear();
    active.for_row(v, [&](const ViewSurface& view, int id) {
      for (int s = 0; s < kSamples; ++s) draw_pinhole(view, id, p, v, s, &row);
    });
    owners.ids.insert(owners.ids.end(), row.owner_of(0), row.owner_of(0) + p.width);
    for (int u = 0; u < p.width; ++u) labels.pixels.push_back(uint8_t(kind_of_pixel(row, u, v, views, p)));
  }
  mark_between(owners, views, p, &labels);
  return labels;
}

// The clean image and its slope, gray levels per pixel.
struct Clean {
  int width;
  std::vector<float> gray;
  float at(int u, int v) const { return gray[size_t(v) * size_t(width) + size_t(u)]; }
  Eigen::Vector2f slope(int u, int v) const {
    return 0.5f * Eigen::Vector2f(at(u + 1, v) - at(u - 1, v), at(u, v + 1) - at(u, v - 1));
  }
};

Clean clean_image(const Look& look) {
  Clean clean{look.width(), std::vector<float>(size_t(look.width()) * look.height())};
  add_rows_seen(look.scene, LensRays(), look.at, {0, look.height()}, &clean.gray);
  return clean;
}

// The slope is nowhere steeper one pixel to either side along it.
bool is_steepest(const Clean& clean, int u, int v) {
  const Eigen::Vector2f g = clean.slope(u, v);
  const float steepness = g.norm();
  if (steepness < kMinTextureSlope) return false;
  const int du = int(std::lround(g.x() / steepness)), dv = int(std::lround(g.y() / steepness));
  // Of equal neighbours the first counts, so that a step between pixels is not marked twice; equal but for
  // rounding.
  constexpr float kEqual = 1e-2f;
  return steepness > clean.slope(u - du, v - dv).norm() + kEqual &&
         steepness >= clean.slope(u + du, v + dv).norm() - kEqual;
}

bool is_clear_of_geometry(const GrayImage& labels, int u, int v) {
  for (int dv = -1; dv <= 1; ++dv)
    for (int du = -1; du <= 1; ++du)
      if (labels.pixels[size_t(v + dv) * size_t(labels.width) + size_t(u + du)] > uint8_t(TrueEdge::texture))
        return false;
  return true;
}

}  // namespace

GrayImage true_edge_labels(const SceneRenderer& renderer, int index) {
  constexpr int kReach = 2;  // pixels: the slope of a neighbour
  const Look look = look_of(renderer, index);
  GrayImage labels = geometric_labels(look);
  const Clean clean = clean_image(look);
  for (int v = kReach; v < look.height() - kReach; ++v)
    for (int u = kReach; u < look.width() - kReach; ++u)
      if (is_clear_of_geometry(labels, u, v) && is_steepest(clean, u, v))
        labels.pixels[size_t(v) * size_t(look.width()) + size_t(u)] = uint8_t(TrueEdge::texture);
  return labels;
}

}  // namespace edgevo
