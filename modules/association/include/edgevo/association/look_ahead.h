#pragma once
// Keyframes of the window have long left the processor's caches, and an association reads a field, then what it says of an index, then
// an edge, then the images around it: each read waits for the one before. Many associations to come are told here, and wait together.
// Saves a fifth of the activation's time (modules/mapping). Nothing but time depends on it.
#include <Eigen/Core>
#include <array>

#include "edgevo/association/association_params.h"
#include "edgevo/edges/frame_pyramid.h"

namespace edgevo {

/// Prefetches what many associations will read. One object a thread.
class LookAhead {
 public:
  explicit LookAhead(const AssociationParams& params) : params_(params) {}  ///< keeps a reference
  /// A point that projects to `px` is going to be associated with `target`.
  void add(const FramePyramid& target, const Eigen::Vector2d& px);
  /// Asks for the memory of what was added, and forgets it. `add` does so when there is too much.
  void run();

 private:
  static constexpr int kAtOnce = 32;  ///< requests that wait for memory together: processors keep about as many open
  struct Place {
    const PyramidLevel* level;
    Eigen::Vector2f px;
    int pixel;  // of the nearest edge, -1: none
  };

  const AssociationParams& params_;
  std::array<Place, kAtOnce> places_;
  int count_ = 0;
};

}  // namespace edgevo
