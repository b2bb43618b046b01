// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Which surface is nearest at each sample point of one image row.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "view.h"

namespace edgevo {

/// Number of sample points of a pixel, a rank-1 lattice relative to its centre, so that edges of any
/// direction have nine different distances. The first is the centre.
constexpr int kSamples = 9;
using SampleOffsets = std::array<Eigen::Vector2f, kSamples>;
const SampleOffsets& sample_offsets();

/// One image row: for each sample s and column u, the largest 1/z so far and its surface.
struct RowSamples {
  RowSamples(int width, int samples)
      : width(width),
        idepth(size_t(width) * samples),
        owner(size_t(width) * samples),
        x(size_t(width) * samples) {}
  void clear() {
    std::fill(idepth.begin(), idepth.end(), 0.0f);
    std::fill(owner.begin(), owner.end(), -1);
  }
  float* idepth_of(int s) { return idepth.data() + size_t(s) * width; }
  int32_t* owner_of(int s) { return owner.data() + size_t(s) * width; }

  int width;
  std::vector<float> idepth;
  /// Number of the surface; -1: sky.
  std::vector<int32_t> owner;
  /// Normalised x of each sample (pinhole only); the same in every row.
  std::vector<float> x;
};

/// Prepares RowSamples::x for `samples` points of a pinhole camera.
void set_sample_columns(const Pinhole& pinhole, int samples, RowSamples* row);

/// Enters surface number `id` into sample `s` of a pinhole camera's row `v`.
void draw_pinhole(const ViewSurface& view, int id, const Pinhole& pinhole, int v, int s, RowSamples* row);

/// As draw_pinhole(), for samples with individual rays (x, y): `rays` holds those of this row and sample, one
/// for each column; a ray of NaN meets nothing.
void draw_along_rays(const ViewSurface& view, int id, const Eigen::Vector2f* rays, int s, RowSamples* row);

}  // namespace edgevo
