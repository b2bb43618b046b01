// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Memory prefetching for associations. The keyframes of the window are no longer in the processor's caches,
// and each association reads a field, then an index, then an edge, then the images around it, each read
// waiting for the one before. Announcing many associations in advance lets these reads overlap. It saves a
// fifth of the time of the point activation (modules/mapping) and does not change results.
#include <Eigen/Core>
#include <array>

#include "edgevo/association/association_params.h"
#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// Prefetches the memory that many associations will read. Use one object per thread.
class Prefetcher {
 public:
  /// Number of requests that overlap: processors keep about as many pending.
  static constexpr int kAtOnce = 32;

  /// Keeps a reference to `params`.
  explicit Prefetcher(const AssociationParams& params) : params_(params) {}
  /// Announces an association of a point that projects to `px` with `target`.
  void add(const FramePyramid& target, const Eigen::Vector2d& px);
  /// Prefetches the memory for the announced points and forgets them; add() calls it when the buffer is full.
  /// Returns the number of points that have an edge nearby: for the others only the field is prefetched.
  int run();
  /// Number of announced points that run() has not handled yet, at most kAtOnce.
  int waiting() const { return count_; }

 private:
  struct Slot {
    const PyramidLevel* level;
    Eigen::Vector2f px;
    int pixel;  // of the nearest edge; -1: none
  };

  const AssociationParams& params_;
  std::array<Slot, kAtOnce> slots_;
  int count_ = 0;
};

}  // namespace edgevo
