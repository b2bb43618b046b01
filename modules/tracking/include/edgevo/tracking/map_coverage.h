// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Detects that the map is out of view. A rotation can be followed with points of unknown depth, a translation
// only while what is left of the map explains the images. Where it does not, a new map is worth more than the
// old one (lab 2026-11-22_rotation_on_the_spot).
#include "edgevo/confidence/status_params.h"
#include "edgevo/core/frame_evidence.h"

namespace edgevo {

/// Whether the map is in view.
enum class MapInView { kYes, kNo, kUncertain };

/// Watches how well the part of the map in view explains the frames.
class MapCoverage {
 public:
  /// `may_be_out_of_view` false: the answer is never kNo. It is kNo after twelve more frames that
  /// the map does not explain than frames that it explains.
  MapCoverage(bool may_be_out_of_view, const StatusParams& params)
      : may_be_out_of_view_(may_be_out_of_view), params_(params) {}

  /// Call after each frame with a pose.
  MapInView look(const FrameEvidence& evidence);
  /// Starts over with a new map.
  void restart() { unexplained_frames_ = 0; }

 private:
  bool may_be_out_of_view_;
  StatusParams params_;
  /// Recent frames that the map does not explain, less those that it explains; never negative.
  int unexplained_frames_ = 0;
};

}  // namespace edgevo
