#include "edgevo/odometry/keyframe_params.h"

namespace edgevo {

void KeyframeParams::visit(ParamVisitor& v) {
  v.number("flow_px", flow_px, 1, 500,
           "rms image motion by translation that makes a keyframe, at 1241 pixels width");
  v.number("min_flow_px", min_flow_px, 0, 500, "no keyframe below it: standstill or pure rotation");
  v.number("min_view_share", min_view_share, 0, 1, "keyframe before a smaller share of the cloud is in view");
  v.number("max_view_loss", max_view_loss, 0, 1,
           "keyframe where a larger share of the cloud leaves the view each frame");
  v.number("min_turn_share", min_turn_share, 0, 1,
           "keyframe below this share in view even without translation");
  v.integer("max_frames", max_frames, 1, 10000, "keyframe after so many frames, if there was motion");
}

}  // namespace edgevo
