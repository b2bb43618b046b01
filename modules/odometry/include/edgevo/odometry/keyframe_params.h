#pragma once
#include "edgevo/core/params.h"

namespace edgevo {

/// When a frame becomes a keyframe (odometry/src/keyframe_policy.h).
struct KeyframeParams {
  /// px at 1241 pixels width; scales with the width. Half of it where the view opens
  double flow_px = 40;
  /// px at 1241 pixels width
  double min_flow_px = 4;
  /// share of the cloud
  double min_view_share = 0.75;
  /// share of the cloud a frame
  double max_view_loss = 0.075;
  /// share of the cloud
  double min_turn_share = 0.55;
  /// frames
  int max_frames = 200;
  /// Where the camera backs away, keyframes are made at down to half of flow_px.
  bool shorten_in_opening_view = true;
  /// A camera that is back at an older keyframe of the window is tracked against that one.
  bool return_to_keyframes = true;

  /// Names, ranges and texts of the fields (core/params.h).
  void visit(ParamVisitor& v);
};

}  // namespace edgevo
