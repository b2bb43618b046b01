// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A mapper that runs along the sweep of the hollow scene.
#include <map>
#include <memory>
#include <string>

#include "edgevo/alignment/tracker.h"
#include "edgevo/confidence/frame_status.h"
#include "edgevo/mapping/mapper.h"
#include "support/sweep_scene.h"

namespace edgevo::test {

/// Parameters of a mapper that neither calibrates the camera nor makes lines.
inline MapperParams window_only(const MappingParams& mapping) {
  MapperParams params;
  params.camera.refine = "none";
  params.edge_map.mode = "off";
  params.mapping = mapping;
  return params;
}

/// Feeds frames of the sweep to a mapper, aligned to its reference as by the odometry.
class SweepDriver {
 public:
  explicit SweepDriver(const MappingParams& params, uint64_t seed = 1)
      : SweepDriver(window_only(params), {seed, false, {}, std::make_shared<MapLog>(), {}}) {}
  /// `options` with a log.
  SweepDriver(const MapperParams& params, const MapperOptions& options)
      : log(options.log), events(log), mapper(Sweep::pinhole(), params, options) {}

  std::string start(int first = 0, int last = 8, double unit = 1.0) {
    unit_ = unit;
    const std::string problem = to_string(mapper.initialise(true_bootstrap(first, last, unit)));
    if (problem.empty()) mapper.begin_segment(segments_++);
    return problem;
  }

  /// Aligns frame `f`, starting from the true motion between it and the reference.
  TrackedFrame align(int f, bool make_keyframe) const {
    const auto reference = mapper.reference();
    const SE3 T = sweep_pose(f).inverse() * sweep_pose(frame_of.at(reference->keyframe_id));
    const SE3 start(T.rotation(), unit_ * T.translation());
    const TrackResult r = edgevo::track(*Sweep::pyramid(f), reference->cloud, {start},
                                        SupportScorer(StatusParams()), AlignmentParams());
    TrackedFrame frame;
    frame.frame_index = f;
    frame.time = Sweep::time(f);
    frame.pyramid = Sweep::pyramid(f);
    frame.reference_id = reference->keyframe_id;
    frame.T_cam_ref = r.T_cur_ref;
    frame.covariance = r.covariance;
    frame.make_keyframe = make_keyframe;
    return frame;
  }
  MapUpdate process(int f, bool make_keyframe) {
    note_keyframes();
    const MapUpdate update = mapper.process(align(f, make_keyframe));
    note_keyframes();
    return update;
  }
  void note_keyframes() {
    for (const Keyframe& k : mapper.window().keyframes()) frame_of[k.id] = k.frame_index;
  }

  std::shared_ptr<MapLog> log;
  MapCursor events;
  Mapper mapper;
  /// Frame index by keyframe id.
  std::map<int, int> frame_of;

 private:
  double unit_ = 1;
  int segments_ = 0;
};

}  // namespace edgevo::test
