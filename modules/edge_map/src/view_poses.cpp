// SPDX-License-Identifier: BSD-3-Clause
#include "view_poses.h"

#include <utility>

#include "edgevo/alignment/edge_alignment.h"
#include "edgevo/confidence/frame_status.h"

namespace edgevo {

void align_tracked_views(std::vector<CloudPoint> points, const ViewAlignment& how,
                         std::vector<EdgeView>* views) {
  ReferenceCloud cloud;
  cloud.points = std::move(points);
  const SupportScorer scorer(how.status);
  for (EdgeView& view : *views) {
    if (!view.is_tracked) continue;
    PoseCandidate pose{view.T_view_host, {}, {}};
    pose.stats = align_edges(*view.pyramid, cloud, 0, how.alignment, &pose.T_cur_ref);
    pose.evidence = weigh_evidence(*view.pyramid, cloud, pose.T_cur_ref, how.alignment);
    if (scorer.fits(pose)) view.T_view_host = pose.T_cur_ref;
  }
}

}  // namespace edgevo
