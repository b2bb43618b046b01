// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Holds the pose of a camera that stands while something large crosses its view. Edges alone show that much
// of the view keeps its place (StillCells), which is no proof: to a camera that moves slowly what is
// far away stands still, too, and the rim of a round image always does. So it counts only where the view
// supports no pose, and two explanations are compared on that part of it: the pose that was found, and that
// of the time when the part began to keep its place. A pose that moves the points there and explains no more
// of them is refuted. A lorry that is followed at its own speed stands still in the image, too, and its edges
// may have come into the map while it was caught up with: a pose is only held where the camera was seen to
// stand before, with a view that supported it.
#include <memory>
#include <optional>

#include "edgevo/alignment/alignment_params.h"
#include "edgevo/alignment/reference.h"
#include "edgevo/segmentation/still_cells.h"

namespace edgevo {

/// The pose from which on the view has stood still. For the thread that tracks.
class StationaryDetector {
 public:
  /// The points of the reference in the part of a frame that stands still, `cells`, if the camera stands
  /// rather than has the pose found for that frame, which is not supported well; null if not, if it was not
  /// seen to stand before, or if there are too few points. Cost: nothing while the view moves, else some 0.1
  /// ms.
  std::shared_ptr<const Reference> still_part(const FramePyramid& frame, const StillCells& cells,
                                              const std::shared_ptr<const Reference>& reference,
                                              const SE3& T_cur_ref, const AlignmentParams& params) const;
  /// Whether the camera is known to stand with the pose T_cur_ref: it leaves most known points of the still
  /// part where they were, and `typical_step`, a translation in the camera's axes, would not: they are near
  /// enough to show that it has not been made. Cost: nothing while the view moves, else some 0.05 ms.
  bool stands(const StillCells& cells, const Pinhole& camera, const ReferenceCloud& cloud,
              const SE3& T_cur_ref, const Eigen::Vector3d& typical_step) const;
  /// Pose of the camera while it stands; only after still_part() has found one.
  const SE3& T_standing_ref() const { return *T_standing_ref_; }
  /// Adopts the pose of a frame; `stands`: as stands() found for it.
  void follow(const StillCells& cells, const SE3& T_cur_ref, bool stands);
  /// Changes to another reference keyframe (MotionModel::change_reference).
  void change_reference(const SE3& T_old_new);
  /// Forgets the pose.
  void clear() { T_standing_ref_.reset(); }

 private:
  std::optional<SE3> T_standing_ref_;
  bool was_seen_to_stand_ = false;  // since T_standing_ref_
};

}  // namespace edgevo
