#pragma once
// Which surface is nearest at each sample point of one image row.
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "view.h"

namespace edgevo {

/// Sample points of a pixel, relative to its centre: a rank-1 lattice of nine, so that edges of any direction
/// find nine different distances. The first is the centre.
constexpr int kSamples = 9;
using SampleOffsets = std::array<Eigen::Vector2f, kSamples>;
const SampleOffsets& sample_offsets();

/// One image row: for each sample s and column u, the largest 1/z so far and the surface that has it.
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
  std::vector<int32_t> owner;  ///< number of the surface, -1: sky
  std::vector<float> x;        ///< normalised x of each sample (pinhole only); the same in every row
};

/// Prepares RowSamples::x for `samples` points of a pinhole camera.
void set_sample_columns(const Pinhole& pinhole, int samples, RowSamples* row);

/// Enters surface number `id` into sample `s` of a pinhole camera's row `v`.
void draw_pinhole(const ViewSurface& view, int id, const Pinhole& pinhole, int v, int s, RowSamples* row);

/// The same where each sample has a ray (x, y) of its own: `rays` holds those of this row and sample, one a
/// column.
void draw_along_rays(const ViewSurface& view, int id, const Eigen::Vector2f* rays, int s, RowSamples* row);

}  // namespace edgevo
