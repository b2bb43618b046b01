// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/tracking/keyframe_params.h"

namespace edgevo {

void KeyframeParams::visit(ParamVisitor& v) {
  v.number(kBasic, "flow_px", flow_px, 1, 500,
           "rms image motion by translation that calls for a keyframe, pixels at 1241 pixels width");
  v.number(kAdvanced, "min_flow_px", min_flow_px, 0, 500,
           "image motion below which no keyframe is made (standstill, pure rotation), pixels at 1241 pixels "
           "width");
  v.number(kAdvanced, "min_view_share", min_view_share, 0, 1,
           "make a keyframe before less than this share of the cloud is in view");
  v.number(kAdvanced, "max_view_loss", max_view_loss, 0, 1,
           "make a keyframe if a larger share of the cloud leaves the view per frame, as in a fast turn");
  v.number(kAdvanced, "min_turn_share", min_turn_share, 0, 1,
           "make a keyframe if less than this share of the cloud is in view, even without translation, to "
           "follow a rotation");
  v.integer(kAdvanced, "max_frames", max_frames, 1, 10000,
            "frames after which a keyframe is made if the camera has moved");
  v.boolean(kExperimental, "shorten_in_expanding_view", shorten_in_expanding_view,
            "make keyframes at down to half of flow_px where the camera backs away");
  v.boolean(kExperimental, "return_to_keyframes", return_to_keyframes,
            "track against an older keyframe of the window where the camera is back at it");
}

}  // namespace edgevo
