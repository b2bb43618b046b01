// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/mapping/epipolar_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "edgevo/alignment/projection.h"
#include "edgevo/association/normal_refinement.h"
#include "edgevo/association/patch_cost.h"
#include "edgevo/association/patch_source.h"
#include "edgevo/association/warp.h"
#include "epipolar_segment.h"

namespace edgevo {
namespace {

// Pixels: on a shorter segment a match does not constrain depth, since an edge is located to about half a
// pixel.
constexpr double kMinSegmentPx = 1.5;
// A patch of two pixels' radius and its interpolation stay inside the image.
constexpr double kBorderPx = 3;
// Most steps of one search; longer segments are searched in larger steps, which bounds the time.
constexpr double kMaxSteps = 300;
// Two minima further apart are different positions: their patches overlap by less than half.
constexpr double kSeparatePx = 2.5;
// Patches with costs (of 0 to 2) below are equal: their ratio means nothing.
constexpr double kEqualCost = 1e-3;
// Five by five pixels: small, since the appearance changes with the viewing angle.
constexpr int kPatchRadiusPx = 2;
// Depths within this ratio share one warp: a patch of five pixels changes by less than one pixel.
constexpr double kSameWarpRatio = 1.3;
// How far a crossing may lie outside the segment: edges are located to half a pixel.
constexpr double kBeyondEndPx = 1;
// Edges more parallel to the epipolar line give no depth.
constexpr double kMinEpipolarCosine = 0.25;
// Edges this close to the epipolar line are candidates.
constexpr double kMaxEdgeDistancePx = 1.5;
// Gate on the angle between the two edge normals, signed: 45 degrees.
constexpr double kMinNormalCosine = 0.7;
constexpr double kEpipolarSigmaPx = 0.3;  // position noise of the epipolar line
// Largest distance from the step to the crossing: beyond, another step of the line has a nearer edge.
constexpr double kMaxSlidePx = 2.5;
// Crossings this close are those of neighbouring pixels of one edge.
constexpr double kSameCrossingPx = 0.3;

class EpipolarSearch {
 public:
  EpipolarSearch(const FramePyramid& host, const PyramidLevel& target, const Eigen::Vector2d& px_host,
                 const Eigen::Vector2d& normal_host, const SE3& T_target_host,
                 const DepthFilterParams& params)
      : host_(host),
        target_(target),
        px_host_(px_host),
        normal_host_(normal_host),
        T_(T_target_host),
        params_(params),
        rotated_ray_(T_target_host.R() * target.pinhole.ray(px_host)) {
    crossings_.clear();
  }

  EpipolarMatch run(const IdepthRange& range) {
    EpipolarMatch result;
    EpipolarSegment s = epipolar_segment(target_.pinhole, rotated_ray_, T_.translation(), range);
    if (!s.visible) return outcome(EpipolarOutcome::kOutOfView);
    if (s.length < kMinSegmentPx) return outcome(EpipolarOutcome::kNoBaseline);
    if (!clip(target_.pinhole, kBorderPx, &s)) return outcome(EpipolarOutcome::kOutOfView);
    if (runs_along(s, range)) return outcome(EpipolarOutcome::kAlongLine);
    scan(s);
    if (!(best_.cost < params_.max_cost)) return outcome(EpipolarOutcome::kNoMatch);
    if (std::max(best_.cost, kEqualCost) > params_.max_cost_ratio * second_cost_)
      return outcome(EpipolarOutcome::kAmbiguous);
    return measure(s);
  }

 private:
  struct Candidate {
    double cost = 2;
    double along = 0;  // position on the segment, pixels
    Eigen::Vector2d px, normal;
    double idepth = 0;
  };

  // Searches follow each other thousands of times per frame and share this memory.
  static std::vector<double>& scratch() {
    thread_local std::vector<double> memory;
    return memory;
  }

  static EpipolarMatch outcome(EpipolarOutcome o) {
    EpipolarMatch m;
    m.outcome = o;
    return m;
  }

  // Whether the host's edge, as seen in the target at the middle of the range, runs along the segment.
  bool runs_along(const EpipolarSegment& s, const IdepthRange& range) const {
    const Eigen::Matrix2d A = patch_warp(target_.pinhole, T_, px_host_, 0.5 * (range.low + range.high));
    return std::abs(warp_normal(A, normal_host_).dot(s.direction)) < kMinEpipolarCosine;
  }

  // Steps along the segment that may have an edge within reach.
  struct Batch {
    static constexpr int kSize = 16;  // about as many requests as a core has in flight at once
    std::array<double, kSize> along;  // position on the segment, pixels
    std::array<int, kSize> pixel;     // pixel with the nearest edge
    int count = 0;
  };

  // Scans the segment for edges. A search mostly waits for memory: field, index and edges of a batch are
  // prefetched before they are read.
  void scan(const EpipolarSegment& s) {
    const double step = std::max(1.0, s.length / kMaxSteps);
    const int steps = int(s.length / step) + 1;
    int last_edge = -1;
    Batch batch;
    for (int i = 0; i < steps;) {
      i = take_batch(s, step, i, steps, &batch);
      for (int k = 0; k < batch.count; ++k) target_.field.prefetch_edge(batch.pixel[k]);
      for (int k = 0; k < batch.count; ++k)
        prefetch(&target_.edges.pixels[target_.field.edge_at(batch.pixel[k])]);
      for (int k = 0; k < batch.count; ++k)
        visit(target_.field.edge_at(batch.pixel[k]), s, batch.along[k], &last_edge);
    }
  }

  // Fills a batch from step `i` on; returns the next step.
  int take_batch(const EpipolarSegment& s, double step, int i, int steps, Batch* batch) const {
    const int in_reach = max_squared_distance(kMaxEdgeDistancePx);
    batch->count = 0;
    for (; i < steps && batch->count < Batch::kSize; ++i) {
      const Eigen::Vector2d p = s.start + i * step * s.direction;
      if (target_.field.squared_distance(float(p.x()), float(p.y())) > in_reach) continue;
      const int pixel = target_.field.nearest_pixel(float(p.x()), float(p.y()));
      if (pixel < 0) continue;  // the field's range is smaller than that of the search
      batch->along[batch->count] = i * step;
      batch->pixel[batch->count++] = pixel;
    }
    return i;
  }

  // The largest distance of the field, which is between pixels, at which an edge may lie within `reach` of a
  // position: both may be half a diagonal away from their pixels.
  static int max_squared_distance(double reach) {
    const double between_pixels = reach + std::sqrt(2.0);
    return int(between_pixels * between_pixels);
  }

  // Visits the nearest edge of one step.
  void visit(int edge, const EpipolarSegment& s, double along, int* last_edge) {
    if (edge == *last_edge) return;
    const EdgePixel& e = target_.edges.pixels[edge];
    const Eigen::Vector2d p = s.start + along * s.direction;
    const float reach = float(kMaxEdgeDistancePx);
    if ((e.position() - p.cast<float>()).squaredNorm() > reach * reach) return;
    *last_edge = edge;
    consider(e, s, along, p);
  }

  // Evaluates one edge near the line: where the line crosses its tangent, and how alike it looks there.
  void consider(const EdgePixel& e, const EpipolarSegment& s, double along, const Eigen::Vector2d& p) {
    const Eigen::Vector2d n = e.normal().cast<double>();
    const double cosine = n.dot(s.direction);
    if (std::abs(cosine) < kMinEpipolarCosine) return;
    const double crossing = along + n.dot(e.position().cast<double>() - p) / cosine;
    if (crossing < -kBeyondEndPx || crossing > s.length + kBeyondEndPx) return;
    if (std::abs(crossing - along) > kMaxSlidePx) return;
    for (double known : crossings_)
      if (std::abs(known - crossing) < kSameCrossingPx) return;
    Candidate c;
    c.along = crossing;
    c.px = s.start + crossing * s.direction;
    c.normal = n;
    c.idepth = triangulate_idepth(target_.pinhole, rotated_ray_, T_.translation(), c.px, s.direction);
    if (!(c.idepth > 0) || !prepare_warp(c.idepth)) return;
    if (warp_normal(A_, normal_host_).dot(n) < kMinNormalCosine) return;
    crossings_.push_back(crossing);
    c.cost = patch_cost(patch_, target_.gradient_magnitude.view(), c.px.x(), c.px.y());
    rank(c);
  }

  // The second best counts only if it is at a different position.
  void rank(const Candidate& c) {
    if (c.cost < best_.cost) {
      if (std::abs(c.along - best_.along) > kSeparatePx) second_cost_ = std::min(second_cost_, best_.cost);
      best_ = c;
    } else if (std::abs(c.along - best_.along) > kSeparatePx) {
      second_cost_ = std::min(second_cost_, c.cost);
    }
  }

  bool prepare_warp(double idepth) {
    if (warp_idepth_ > 0 && idepth < warp_idepth_ * kSameWarpRatio && idepth * kSameWarpRatio > warp_idepth_)
      return warp_ok_;
    warp_idepth_ = idepth;
    A_ = patch_warp(target_.pinhole, T_, px_host_, idepth);
    const PatchSource from = patch_source(host_, px_host_, A_);
    warp_ok_ = sample_warped(from.level->gradient_magnitude.view(), from.px, from.A_target_host,
                             kPatchRadiusPx, &patch_) &&
               divide_by_mean(&patch_);
    return warp_ok_;
  }

  // Depth and its sigma at the best candidate, refined along its normal if requested.
  EpipolarMatch measure(const EpipolarSegment& s) {
    double cosine = best_.normal.dot(s.direction);
    if (params_.refine) {
      const Eigen::Matrix2d A = patch_warp(target_.pinhole, T_, px_host_, best_.idepth);
      const PatchSource from = patch_source(host_, px_host_, A);
      NormalTemplate patch;
      const bool is_made = from.level->with_gray([&](const auto& gray) {
        return make_normal_template(gray, from.px, from.A_target_host, best_.normal, kRefinementRadius,
                                    &patch);
      });
      if (!is_made) return outcome(EpipolarOutcome::kNoMatch);
      const NormalRefinement r = target_.with_gray(
          [&](const auto& gray) { return refine_along_normal(patch, gray, best_.px, best_.normal); });
      if (!r.accepted) return outcome(EpipolarOutcome::kNoMatch);
      best_.px += s.direction * (r.move_px / cosine);  // back onto the epipolar line
    }
    EpipolarMatch m;
    const auto idepth_at = [&](double offset) {
      return triangulate_idepth(target_.pinhole, rotated_ray_, T_.translation(),
                                best_.px + offset * s.direction, s.direction);
    };
    m.px = best_.px;
    m.idepth = idepth_at(0);
    const double per_px = idepth_at(0.5) - idepth_at(-0.5);
    const double sigma_px = std::hypot(params_.sigma_edge_px, kEpipolarSigmaPx) / std::abs(cosine);
    m.idepth_sigma = std::abs(per_px) * sigma_px;
    const bool usable = m.idepth > 0 && std::isfinite(m.idepth_sigma) && m.idepth_sigma > 0;
    m.outcome = usable ? EpipolarOutcome::kFound : EpipolarOutcome::kNoBaseline;
    return m;
  }

  const FramePyramid& host_;
  const PyramidLevel& target_;
  Eigen::Vector2d px_host_, normal_host_;
  const SE3& T_;
  const DepthFilterParams& params_;
  Eigen::Vector3d rotated_ray_;
  double warp_idepth_ = 0;
  bool warp_ok_ = false;
  Eigen::Matrix2d A_ = Eigen::Matrix2d::Identity();
  Patch patch_;
  std::vector<double>& crossings_ = scratch();  // crossings of the segment with edges, pixels along it
  Candidate best_;
  double second_cost_ = 2;
};

}  // namespace

double triangulate_idepth(const Pinhole& camera, const Eigen::Vector3d& r, const Eigen::Vector3d& t,
                          const Eigen::Vector2d& px, const Eigen::Vector2d& epipolar_direction) {
  // x' (r_z + rho t_z) = r_x + rho t_x, and the same in y.
  const Eigen::Vector3d x = camera.ray(px);
  const int axis = std::abs(epipolar_direction.x()) > std::abs(epipolar_direction.y()) ? 0 : 1;
  return (x[axis] * r.z() - r[axis]) / (t[axis] - x[axis] * t.z());
}

EpipolarMatch search_epipolar(const FramePyramid& host, const FramePyramid& target,
                              const Eigen::Vector2d& px_host, const Eigen::Vector2d& normal_host,
                              const SE3& T_target_host, const IdepthRange& range,
                              const DepthFilterParams& params) {
  return EpipolarSearch(host, target.finest(), px_host, normal_host, T_target_host, params).run(range);
}

}  // namespace edgevo
