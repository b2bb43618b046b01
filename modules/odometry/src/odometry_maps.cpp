// SPDX-License-Identifier: BSD-3-Clause
// Odometry: making a map, in the thread of the frames or next to them.
#include <cmath>
#include <optional>
#include <string>

#include "edgevo/core/doubtful_frame.h"
#include "edgevo/core/stage_timer.h"
#include "edgevo/core/trace.h"
#include "odometry_impl.h"

namespace edgevo {

// ---- making a map ----

void Odometry::Impl::forget_views() {
  bootstrapper.reset();
  if (concurrent) concurrent->reset();
}

void Odometry::Impl::bootstrap_map(const ArrivedFrame& now) {
  FrameRecord& record = *now.record;
  const StageTimer timer(Stage::kBootstrap, &record.stage_ms);
  frame_published = false;  // times and note change
  record.evidence.stands = now.still.show_it();
  if (!concurrent) replay.add(now);
  const std::optional<LocatedPose> located = locate(now);
  const BootstrapStatus status = concurrent ? search_concurrently(now, located) : search_and_make(now);
  if (!record.T_world_cam_live) refuse_pose(&record, status.reasons);
}

std::optional<LocatedPose> Odometry::Impl::locate(const ArrivedFrame& now) {
  if (!options.locate || !state.may_be_located()) return std::nullopt;
  ++images_tried;
  const std::optional<LocatedPose> found = options.locate(*now.pyramid);
  if (!found) return std::nullopt;
  if (state.locate()) {
    // The first view is to be one that is located.
    forget_views();
    if (!concurrent) replay.views_dropped();
    frames.begin_segment({state.segment(), Sim3(), SegmentPlaced::Method::kLinked});
    report(now.frame, "located in the kept map");
  }
  frames.place(state.segment(), *found);
  bootstrapper.locate(now.frame, *found);
  assign_status({TrackingState::kTracking, {}}, now.record);
  return found;
}

bool Odometry::Impl::may_be_located() const {
  return options.locate && !has_begun_map && images_tried < kImagesToLocate;
}

// Until places are recognised by keyframes that leave the window. The frame's pose in the young map, by which
// the keyframe is placed, is as uncertain as the unit of that.
void Odometry::Impl::place_young_map(const ArrivedFrame& now) {
  const Reference& reference = *front_end.reference();
  if (reference.keyframe_id >= params.mapping.window.keyframes) options.locate = {};
  const bool is_known = keyframes_located.count(reference.keyframe_id) > 0;
  if (!options.locate || concurrent || is_map_in_doubt(*now.record) || is_known) return;
  const StageTimer timer(Stage::kBootstrap, &now.record->stage_ms);
  const std::optional<LocatedPose> found = options.locate(*now.pyramid);
  if (!found) return;
  keyframes_located.insert(reference.keyframe_id);
  const SE3& T_cam_map = *newest_pose.T_cam_map;
  SegmentPlaced placed = locate_segment(state.segment(), *found, T_cam_map, 1 / reference.median_idepth);
  const double length =
      placed.T_world_map.scale * (T_cam_map * reference.T_ref_world.inverse()).translation().norm();
  placed.position_sigma = std::hypot(placed.position_sigma, placed.scale_sigma * length);
  Constraint place = place_of(reference.keyframe_id, reference.T_ref_world, placed);
  place.kind = ConstraintKind::kPlace;
  frames.add_constraint(place);
}

void Odometry::Impl::refuse_pose(FrameRecord* record, const Reasons& why) const {
  assign_status({state.without_pose(record->index, record->evidence.edges), joined(record->reasons, why)},
                record);
}

// Without the part that has been found: of the few frames from now on a map would be worse, and those before
// would get their poses with the part among their edges.
void Odometry::Impl::look_again() {
  const TraceScope traced("views without a part");
  replay.look_again([&](const std::shared_ptr<const FramePyramid>& p) { return front_end.masked_anew(p); });
}

BootstrapStatus Odometry::Impl::search_and_make(const ArrivedFrame& now) {
  if (replay.is_mask_another() && !now.may_show_ego_part) {
    look_again();
    if (!options.locate) bootstrapper.begin_with(replay.views());
  }
  BootstrapStatus status = bootstrapper.add(now);
  // The views are kept: a map of later ones, if there is no such part, places all frames.
  if (status.result &&
      ego_mask_monitor.delays_map(now.may_show_ego_part, now.still, int(status.result->views.size()) - 1))
    return {std::nullopt, {{ReasonKind::kMayBeEgoPart}}};
  if (!status.result && !now.still.empty())
    return {std::nullopt, {{now.still.is_certain ? ReasonKind::kStands : ReasonKind::kMayBeEgoPart}}};
  if (!status.result) return status;
  if (may_be_located()) return {std::nullopt, {{ReasonKind::kMayBeLocated}}};
  bootstrapper.rectify_rows(&*status.result);
  status.reasons = make_map(now, *status.result);
  return status;
}

Reasons Odometry::Impl::make_map(const ArrivedFrame& now, const BootstrapResult& views) {
  const TraceScope traced("first map");
  const std::optional<double> scale = scale_by_depths();
  Reasons problem = bootstrapper.make_map(views);
  front_end.drop_map();
  state.after(problem.empty() ? Event::kMapMade : Event::kMapRefused, now.frame.index);
  if (problem.empty())
    begin_segment(now, bootstrapper.begin_segment(state.segment(), views, integrity.newest_before(), scale));
  if (problem.empty() && replay.is_needed()) look_again();
  if (problem.empty())
    replay.place(views, *front_end.reference(), state.segment(), front_end.params(), &frames);
  if (problem.empty()) integrity.begin_map(), confidence.begin_map(), zoom_change.interrupt();
  return problem;
}

std::optional<double> Odometry::Impl::scale_by_depths() const {
  if (!state.has_pose()) return std::nullopt;
  return frames.T_odom_map(state.segment()).scale / front_end.reference()->median_idepth / kFirstMedianDepth;
}

void Odometry::Impl::begin_segment(const ArrivedFrame& now, const NewSegment& begun) {
  front_end.begin_map(begun.reference, begun.motion);
  newest_pose.T_cam_map = begun.reference->T_ref_world;
  assign_status({now.record->state, {}}, now.record);
  record_segment(now.frame, begun);
}

void Odometry::Impl::record_segment(const Frame& frame, const NewSegment& begun) {
  if (concurrent || has_begun_map) options.locate = {};  // what it holds is not needed any more
  has_begun_map = true;
  if (corners) corners->begin_map(begun.reference->median_idepth);
  report(frame, "map of " + std::to_string(begun.reference->cloud.points.size()) + " edge points, segment " +
                    std::to_string(state.segment()) + "; " + begun.why);
}

// ---- making a map next to the frames (concurrent_bootstrap.h) ----

bool Odometry::Impl::waits_for_map() const { return concurrent && concurrent->frames_wait(); }

const FrameRecord& Odometry::Impl::buffer_frame(const Frame& frame, const ImageExposure& exposure) {
  const ArrivedFrame now = find_edges(frame, false, exposure);
  track_features(now, std::nullopt);
  concurrent->keep(now);
  refuse_pose(now.record, {{ReasonKind::kMapInMaking}});
  return *now.record;
}

BootstrapStatus Odometry::Impl::search_concurrently(const ArrivedFrame& now,
                                                    const std::optional<LocatedPose>& located) {
  const BootstrapStatus status =
      concurrent->look(now, ego_mask_monitor, integrity.newest_before(), located, may_be_located());
  if (concurrent->is_making()) scale_of_made = scale_by_depths();
  return status;
}

void Odometry::Impl::continue_with_map() {
  if (concurrent->is_made()) begin_made_map();
  // Mapping gets the time of every other frame at most, or the frames would never be caught up with.
  holds = !holds && is_mapping_behind() && map.is_keyframe_pending();
  for (int n = 0; !holds && n < ConcurrentBootstrap::kReplayedAtOnce && concurrent->catches_up(); ++n)
    replay_next();
}

void Odometry::Impl::begin_made_map() {
  const MadeMap made = concurrent->take_map();
  const BootstrapView& last = made.views.views.back();
  front_end.drop_map();
  state.after(made.problem.empty() ? Event::kMapMade : Event::kMapRefused, last.frame_index);
  if (!made.problem.empty())
    return report({last.frame_index, last.time, {}, {}}, "no map: " + to_string(made.problem));
  const NewSegment begun = bootstrapper.begin_segment(state.segment(), made.views, integrity.newest_before(),
                                                      scale_of_made, &made.beginning);
  front_end.begin_map(begun.reference, begun.motion, last.time);
  integrity.begin_map();
  confidence.begin_map();
  zoom_change.interrupt();
  record_segment({last.frame_index, last.time, {}, {}}, begun);
  frames.publish();  // the newest frame may be one of the views, or late
}

void Odometry::Impl::replay_next() {
  const BufferedFrame late = concurrent->take_buffered();
  std::optional<FrameRecord> record = frames.find(late.frame.index);
  if (!record) return;
  const TraceScope traced("late frame", late.frame.index);
  change_reference(late.frame);
  front_end.begin_frame(late.frame.time);
  follow_map({late.frame, late.pyramid, late.rows, late.still, false, &*record}, true);
  frames.publish();
  if (!state.has_pose()) concurrent->drop_buffered();
}

void Odometry::Impl::replay_at_end() {
  if (concurrent->is_making()) begin_made_map();
  while (concurrent->catches_up()) {
    if (is_mapping_behind()) map.wait_keyframe();
    replay_next();
  }
}

}  // namespace edgevo
