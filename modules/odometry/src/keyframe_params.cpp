#include "edgevo/odometry/keyframe_params.h"

namespace edgevo {

void KeyframeParams::visit(ParamVisitor& v) {
  v.number(kBasic, "flow_px", flow_px, 1, 500,
           "rms image motion by translation that makes a keyframe, at 1241 pixels width");
  v.number(kAdvanced, "min_flow_px", min_flow_px, 0, 500,
           "no keyframe below it: standstill or pure rotation");
  v.number(kAdvanced, "min_view_share", min_view_share, 0, 1,
           "keyframe before a smaller share of the cloud is in view");
  v.number(kAdvanced, "max_view_loss", max_view_loss, 0, 1,
           "keyframe where a larger share of the cloud leaves the view each frame, as in a fast turn");
  v.number(kAdvanced, "min_turn_share", min_turn_share, 0, 1,
           "keyframe below this share in view even without translation, to follow a rotation");
  v.integer(kAdvanced, "max_frames", max_frames, 1, 10000,
            "keyframe after so many frames, if there was motion");
  v.boolean(kExperimental, "shorten_in_opening_view", shorten_in_opening_view,
            "keyframes at down to half of flow_px where the camera backs away");
  v.boolean(kExperimental, "return_to_keyframes", return_to_keyframes,
            "track against an older keyframe of the window where the camera is back at it");
}

}  // namespace edgevo
