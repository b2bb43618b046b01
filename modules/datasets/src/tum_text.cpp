// SPDX-License-Identifier: BSD-3-Clause
#include "tum_text.h"

#include "edgevo/core/output_file.h"

namespace edgevo {

void append_pose(std::string* text, Timestamp t, const SE3& T_world_cam) {
  *text += to_string(t);
  for (const double v :
       {T_world_cam.translation().x(), T_world_cam.translation().y(), T_world_cam.translation().z()})
    *text += " " + fixed(v, 9);
  const Eigen::Quaterniond& q = T_world_cam.rotation();
  for (const double v : {q.x(), q.y(), q.z(), q.w()}) *text += " " + fixed(v, 9);
  *text += "\n";
}

}  // namespace edgevo
