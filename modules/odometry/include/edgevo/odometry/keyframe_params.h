#pragma once
#include "edgevo/core/params.h"

namespace edgevo {

/// When a frame becomes a keyframe (odometry/src/keyframe_policy.h).
struct KeyframeParams {
  double flow_px = 40;  ///< rms flow by translation alone, at 1241 pixels width; scales with the width. Half
                        ///< of it where the view opens
  double min_flow_px = 4;  ///< below it no keyframe: standstill, or a rotation that keeps the map in view
  double min_view_share = 0.75;  ///< of the cloud; a keyframe before less is in view
  double max_view_loss =
      0.075;  ///< of the cloud, each frame since the last keyframe: a fast turn leaves the map behind
  double min_turn_share =
      0.55;  ///< of the cloud in view; below it a keyframe even without translation, to follow a rotation
  int max_frames = 200;  ///< a keyframe after so many, if there was motion

  void visit(ParamVisitor& v);  ///< names, ranges and texts of the fields (core/params.h)
};

}  // namespace edgevo
