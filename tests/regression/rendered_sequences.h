// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The rendered sequences of the accuracy tests, each rendered once per program: rendering a frame costs ten
// times as much as tracking it.
#include <memory>

#include "edgevo/evaluation/trajectory.h"
#include "edgevo/simulation/clip.h"
#include "edgevo/simulation/scene.h"

namespace edgevo::test {

/// A rendered clip and the true camera pose at each frame.
struct RenderedSequence {
  std::shared_ptr<const Clip> clip;
  Trajectory truth;
};

/// Renders frames begin to end - 1 of a scene.
RenderedSequence render_sequence(const Scene& scene, int begin, int end);

/// Frames begin to end - 1 of a sequence, counted from its first one.
RenderedSequence part_of(const RenderedSequence& sequence, int begin, int end);

/// The sequence played backward.
RenderedSequence backward(const RenderedSequence& sequence);

/// A vehicle driving through a street, 130 frames.
const RenderedSequence& street_sequence();
/// A hand-held camera over a desk, 100 frames.
const RenderedSequence& desk_sequence();
/// A walk along a corridor, 200 frames.
const RenderedSequence& corridor_sequence();

}  // namespace edgevo::test
