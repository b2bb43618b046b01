// SPDX-License-Identifier: BSD-3-Clause
#include "visibility.h"

#include <algorithm>
#include <cmath>

namespace edgevo {
namespace {

// Columns in [begin, end) of a sample row.
struct Span {
  int begin, end;
};

// Where row v, sampled `offset` right of the pixel centres, lies on the surface: in double, so that no crack
// opens between surfaces that share a side.
Span columns_inside(const ViewSurface& view, double v, int width, double offset) {
  double low = 0, high = width - 1;
  for (int i = 0; i < view.left_count; ++i)
    low = std::max(low, view.left[i].slope * v + view.left[i].offset - offset);
  for (int i = 0; i < view.right_count; ++i)
    high = std::min(high, view.right[i].slope * v + view.right[i].offset - offset);
  for (int i = 0; i < view.always_count; ++i)
    if (view.always[i].slope * v + view.always[i].offset < 0) return {0, 0};
  if (!(low <= high)) return {0, 0};
  const int first = int(low);
  return {first + (first < low), int(high) + 1};
}

// Written to vectorise: no branches, no overlapping pointers.
void enter_opaque(const float* __restrict x, float slope, float rest, int32_t id, int count,
                  float* __restrict idepth, int32_t* __restrict owner) {
  for (int u = 0; u < count; ++u) {
    const float q = slope * x[u] + rest, before = idepth[u];
    const int32_t nearer = -int32_t(q > before);
    idepth[u] = std::max(q, before);
    owner[u] = (owner[u] & ~nearer) | (id & nearer);
  }
}

// Planes over ray coordinates: a x + b y + c.
struct RayPlanes {
  float a[5], b[5], c[5];
};

// As above, for samples with individual rays: inside where all five planes are non-negative.
void enter_opaque_inside(const float* __restrict xy, const Eigen::Vector3f& N, const RayPlanes& f, int32_t id,
                         int count, float* __restrict idepth, int32_t* __restrict owner) {
  const float nx = N.x(), ny = N.y(), nz = N.z();
  const RayPlanes g = f;  // by value: it does not change while idepth is written
  for (int u = 0; u < count; ++u) {
    const float x = xy[2 * u], y = xy[2 * u + 1];
    const float q = nx * x + ny * y + nz, before = idepth[u];
    const int32_t nearer =
        -(int32_t(q > before) & int32_t(g.a[0] * x + g.b[0] * y + g.c[0] >= 0) &
          int32_t(g.a[1] * x + g.b[1] * y + g.c[1] >= 0) & int32_t(g.a[2] * x + g.b[2] * y + g.c[2] >= 0) &
          int32_t(g.a[3] * x + g.b[3] * y + g.c[3] >= 0) & int32_t(g.a[4] * x + g.b[4] * y + g.c[4] >= 0));
    idepth[u] = nearer ? q : before;
    owner[u] = (owner[u] & ~nearer) | (id & nearer);
  }
}

// The mip level whose texels are half a pixel or larger, for a cut-out at 1/z = q.
int cut_out_level(const ViewSurface& view, float q, float focal) {
  const Surface& s = *view.surface;
  const float texels_per_metre = float(std::max(s.uv_size.x() * view.texture->width() / s.side_u.norm(),
                                                s.uv_size.y() * view.texture->height() / s.side_v.norm()));
  int level = 0;
  float texels_per_pixel = texels_per_metre / (q * focal);
  for (; texels_per_pixel > 1.4f && level + 1 < int(view.texture->levels.size()); ++level)
    texels_per_pixel *= 0.5f;
  return level;
}

// Linear interpolation of the mask between texel centres, for outlines seen from close by.
bool exists_smooth(const TextureLevel& t, float u, float v) {
  const float x = std::clamp(u - 0.5f, 0.0f, float(t.width) - 1.001f),
              y = std::clamp(v - 0.5f, 0.0f, float(t.height) - 1.001f);
  const int ix = int(x), iy = int(y);
  const float fx = x - float(ix), fy = y - float(iy);
  const uint8_t* upper = t.alpha.data() + size_t(iy) * t.width + ix;
  const uint8_t* lower = upper + t.width;
  const float top = float(upper[0]) * (1 - fx) + float(upper[1]) * fx;
  const float bottom = float(lower[0]) * (1 - fx) + float(lower[1]) * fx;
  return top * (1 - fy) + bottom * fy >= 127.5f;
}

bool exists_nearest(const TextureLevel& t, float u, float v) {
  const int x = std::clamp(int(u), 0, t.width - 1), y = std::clamp(int(v), 0, t.height - 1);
  return t.alpha[size_t(y) * t.width + x] >= 128;
}

// Mask of a cut-out, prepared for evaluation along a row.
struct CutOut {
  CutOut(const ViewSurface& view, float q, float focal) {
    const int n = cut_out_level(view, q, focal);
    const float scale = 1.0f / float(1 << n);
    level = &view.texture->levels[size_t(n)];
    is_smooth = n == 0;
    u = scale * view.u, v = scale * view.v;
  }
  bool operator()(float x, float y, float q) const {
    const float z = 1 / q;
    const float tu = (u.x() * x + u.y() * y + u.z()) * z, tv = (v.x() * x + v.y() * y + v.z()) * z;
    return is_smooth ? exists_smooth(*level, tu, tv) : exists_nearest(*level, tu, tv);
  }
  const TextureLevel* level;
  Eigen::Vector3f u, v;
  bool is_smooth;
};

}  // namespace

const SampleOffsets& sample_offsets() {
  static const SampleOffsets offsets = [] {
    SampleOffsets o;
    for (int i = 0; i < kSamples; ++i) {
      const int k = i <= kSamples / 2 ? i : i - kSamples;  // 0, 1, .. 4, -4, .. -1: the centre first
      int m = (2 * k) % kSamples;
      if (m > kSamples / 2) m -= kSamples;
      if (m < -(kSamples / 2)) m += kSamples;
      o[size_t(i)] = Eigen::Vector2f(float(k), float(m)) / float(kSamples);
    }
    return o;
  }();
  return offsets;
}

void set_sample_columns(const Pinhole& pinhole, int samples, RowSamples* row) {
  for (int s = 0; s < samples; ++s)
    for (int u = 0; u < row->width; ++u)
      row->x[size_t(s) * row->width + u] =
          float((u + double(sample_offsets()[size_t(s)].x()) - pinhole.cx) / pinhole.fx);
}

void draw_pinhole(const ViewSurface& view, int id, const Pinhole& pinhole, int v, int s, RowSamples* row) {
  const Eigen::Vector2f& shift = sample_offsets()[size_t(s)];
  const Span span = columns_inside(view, v + double(shift.y()), pinhole.width, double(shift.x()));
  if (span.begin >= span.end) return;
  const double y = (v + double(shift.y()) - pinhole.cy) / pinhole.fy;
  const float* x = row->x.data() + size_t(s) * row->width;
  const float slope = float(view.idepth.x()), rest = float(view.idepth.y() * y + view.idepth.z());
  float* idepth = row->idepth_of(s);
  int32_t* owner = row->owner_of(s);
  if (!view.texture->is_cut_out())
    return enter_opaque(x + span.begin, slope, rest, id, span.end - span.begin, idepth + span.begin,
                        owner + span.begin);
  const CutOut is_there(view, slope * x[(span.begin + span.end) / 2] + rest, float(pinhole.fx));
  for (int u = span.begin; u < span.end; ++u) {
    const float q = slope * x[u] + rest;
    if (q > idepth[u] && is_there(x[u], float(y), q)) idepth[u] = q, owner[u] = id;
  }
}

void draw_along_rays(const ViewSurface& view, int id, const Eigen::Vector2f* rays, int s, RowSamples* row) {
  constexpr float kSlack = 1e-5f;  // of the surface's size: closes cracks that rounding would open
  const Eigen::Vector3f N = view.idepth.cast<float>();
  RayPlanes f;
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3f plane = view.inside[i].cast<float>() + (i < 4 ? kSlack : 0.0f) * N;
    f.a[i] = plane.x(), f.b[i] = plane.y(), f.c[i] = plane.z();
  }
  float* idepth = row->idepth_of(s);
  int32_t* owner = row->owner_of(s);
  if (!view.texture->is_cut_out())
    return enter_opaque_inside(rays[view.col_begin].data(), N, f, id, view.col_end - view.col_begin,
                               idepth + view.col_begin, owner + view.col_begin);
  const Eigen::Vector2f& middle = rays[(view.col_begin + view.col_end) / 2];
  const float q_middle = std::isnan(middle.x())
                             ? float(1 / view.distance)
                             : std::max(1e-4f, N.x() * middle.x() + N.y() * middle.y() + N.z());
  const CutOut is_there(view, q_middle, 500.0f);
  for (int u = view.col_begin; u < view.col_end; ++u) {
    const float x = rays[u].x(), y = rays[u].y();
    const float q = N.x() * x + N.y() * y + N.z();
    bool inside = q > idepth[u];
    for (int i = 0; i < 5; ++i) inside &= f.a[i] * x + f.b[i] * y + f.c[i] >= 0;
    if (inside && is_there(x, y, q)) idepth[u] = q, owner[u] = id;
  }
}

}  // namespace edgevo
