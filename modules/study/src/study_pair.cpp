// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/study/study_pair.h"

#include "edgevo/confidence/frame_status.h"
#include "edgevo/core/thread_clock.h"

namespace edgevo {

HostView make_host(std::shared_ptr<const FramePyramid> pyramid, std::vector<StudyPoint> points) {
  const Pinhole& camera = pyramid->finest().pinhole;
  std::vector<CloudPoint> cloud;
  for (const StudyPoint& p : points)
    cloud.push_back({camera.ray(p.px), p.idepth, p.idepth_sigma, p.px.cast<float>(), p.normal.cast<float>()});
  HostView host;
  host.cloud = make_reference_cloud(pyramid, std::move(cloud), false);
  host.pyramid = std::move(pyramid);
  host.points = std::move(points);
  return host;
}

TargetView make_target(const HostView& host, std::shared_ptr<const FramePyramid> pyramid,
                       const ViewPair& views, const SE3& T_step) {
  TargetView target;
  target.pyramid = std::move(pyramid);
  target.T_target_host = views.T_to_from;
  const SupportScorer scorer{StatusParams()};
  const double start = thread_cpu_ms();
  target.track =
      track(*target.pyramid, host.cloud, motion_hypotheses(SE3(), T_step), scorer, AlignmentParams());
  target.track_ms = thread_cpu_ms() - start;
  target.is_lost = scorer.is_lost(target.track);
  target.T_start = target.is_lost ? T_step : target.track.T_cur_ref;
  for (const StudyPoint& p : host.points) target.truth.push_back(find_correspondence(views, p.px));
  return target;
}

}  // namespace edgevo
