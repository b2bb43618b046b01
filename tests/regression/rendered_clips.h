#pragma once
// The rendered sequences of the accuracy tests, each rendered once a program: rendering a frame costs ten
// times as much as tracking it.
#include <memory>

#include "edgevo/evaluation/trajectory.h"
#include "edgevo/simulation/clip.h"
#include "edgevo/simulation/scene.h"

namespace edgevo::test {

/// A rendered clip and where the camera was at each of its frames.
struct RenderedDrive {
  std::shared_ptr<const Clip> clip;
  Trajectory truth;
};

RenderedDrive render_drive(const Scene& scene, int begin, int end);

/// Its frames begin <= i < end, counted from the first of the drive.
RenderedDrive part_of(const RenderedDrive& drive, int begin, int end);

/// The last frame first.
RenderedDrive backward(const RenderedDrive& drive);

const RenderedDrive& street_drive();    ///< 130 frames
const RenderedDrive& desk_drive();      ///< 100 frames
const RenderedDrive& corridor_drive();  ///< 200 frames

}  // namespace edgevo::test
