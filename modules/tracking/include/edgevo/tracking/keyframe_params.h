// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "edgevo/core/params.h"

namespace edgevo {

/// Parameters of the decision on keyframes (tracking/keyframe_policy.h).
struct KeyframeParams {
  /// Pixels at 1241 pixels width; scales with the width. Down to half of it in an expanding view.
  double flow_px = 40;
  /// Pixels at 1241 pixels width.
  double min_flow_px = 4;
  /// Share of the cloud.
  double min_view_share = 0.75;
  /// Share of the cloud per frame.
  double max_view_loss = 0.075;
  /// Share of the cloud.
  double min_turn_share = 0.55;
  /// Frames.
  int max_frames = 200;
  /// Make keyframes at down to half of flow_px where the camera backs away.
  bool shorten_in_expanding_view = true;
  /// Track against an older keyframe of the window when the camera is back at it.
  bool return_to_keyframes = true;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
