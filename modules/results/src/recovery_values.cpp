// SPDX-License-Identifier: BSD-3-Clause
#include "recovery_values.h"

#include <memory>
#include <utility>

#include "bytes.h"

// The fields of each type are listed once, in visit() and visit_*(); writing and reading share that list.
namespace edgevo {
namespace {

struct Writing {
  template <class T>
  using Value = const T;

  ByteWriter* out;
  template <class T>
  void plain(const T& v) {
    out->value(v);
  }
  void text(const std::string& t) { out->text(t); }
  void reason(KeyframeReason r) { out->text(std::string(to_string(r))); }
  void pose(const SE3& T) {
    for (int i = 0; i < 3; ++i) out->value(T.translation()[i]);
    for (int i = 0; i < 4; ++i) out->value(T.rotation().coeffs()[i]);
  }
  void node(const NodeId& id) { out->value(id.kind()), out->value(id.number()), out->value(id.epoch()); }
  template <class T, class Each>
  void list(const std::vector<T>& values, const Each& each) {
    out->value(uint32_t(values.size()));
    for (const T& v : values) each(v);
  }
  template <class T, class Each>
  void maybe(const std::optional<T>& value, const Each& each) {
    out->value(value.has_value());
    if (value) each(*value);
  }
  template <class T, class Each>
  void shared(const std::shared_ptr<const T>& value, const Each& each) {
    each(value ? *value : T());
  }
};

struct Reading {
  template <class T>
  using Value = T;

  ByteReader* in;
  template <class T>
  void plain(T& v) {
    v = in->value<T>();
  }
  void text(std::string& t) { t = in->text(); }
  void reason(KeyframeReason& r) { r = parse_keyframe_reason(in->text()).value_or(KeyframeReason::kNone); }
  void pose(SE3& T) {
    double v[7];
    for (double& x : v) x = in->value<double>();
    T = SE3::from_unit({v[6], v[3], v[4], v[5]}, {v[0], v[1], v[2]});
  }
  void node(NodeId& id) {
    const auto kind = in->value<NodeId::Kind>();
    const int number = in->value<int>(), epoch = in->value<int>();
    id = kind == NodeId::Kind::kEpoch      ? NodeId::epoch(number, epoch)
         : kind == NodeId::Kind::kKeyframe ? NodeId::keyframe(number)
                                           : NodeId::world();
  }
  template <class T, class Each>
  void list(std::vector<T>& values, const Each& each) {
    for (auto left = in->value<uint32_t>(); left > 0 && in->ok(); --left) each(values.emplace_back());
  }
  template <class T, class Each>
  void maybe(std::optional<T>& value, const Each& each) {
    if (in->value<bool>()) each(value.emplace());
  }
  template <class T, class Each>
  void shared(std::shared_ptr<const T>& value, const Each& each) {
    auto read = std::make_shared<T>();
    each(*read);
    value = std::move(read);
  }
};

template <class Visit, class Vector>
void visit_numbers(Visit& v, Vector& numbers) {
  for (int i = 0; i < int(numbers.size()); ++i) v.plain(numbers.data()[i]);
}

template <class Visit, class T>
void visit_similarity(Visit& v, T& similarity) {
  v.plain(similarity.scale), v.pose(similarity.rigid);
}

template <class Visit, class T>
void visit_pose(Visit& v, T& pose) {
  v.maybe(pose, [&](auto& p) { v.pose(p); });
}

// Camera is copied as bytes: it holds plain numbers only.
template <class Visit, class Info>
void visit_info(Visit& v, Info& info) {
  v.list(info.command_line, [&](auto& word) { v.text(word); });
  v.text(info.source_kind);
  v.text(info.source_path);
  v.text(info.ground_truth_path);
  v.plain(info.camera);
  v.maybe(info.working_pinhole, [&](auto& pinhole) { v.plain(pinhole); });
  v.text(info.params_yaml);
  v.list(info.input, [&](auto& d) { v.text(d.subject), v.text(d.value), v.text(d.reason), v.text(d.doubt); });
  v.list(info.notes, [&](auto& note) { v.text(note.first), v.text(note.second); });
}

template <class Visit, class Track>
void visit_track(Visit& v, Track& track) {
  v.list(track.positions, [&](auto& p) { v.plain(p.time), visit_numbers(v, p.position); });
  visit_numbers(v, track.sensor_on_vehicle);
}

void visit_tracks(Writing& v, const VehicleTracks& tracks) {
  v.plain(uint32_t(tracks.size()));
  for (const auto& [sensor, track] : tracks) v.plain(sensor), visit_track(v, track);
}
void visit_tracks(Reading& v, VehicleTracks& tracks) {
  for (auto left = v.in->value<uint32_t>(); left > 0 && v.in->ok(); --left)
    visit_track(v, tracks[v.in->value<VehicleSensor>()]);
}

template <class Visit, class Header>
void visit_header(Visit& v, Header& header) {
  visit_info(v, header.info);
  v.text(header.scale);
  visit_tracks(v, header.tracks);
  visit_pose(v, header.T_vehicle_cam);
}

template <class Visit, class Times>
void visit_times(Visit& v, Times& times) {
  v.list(times, [&](auto& stage) { v.text(stage.first), v.plain(stage.second); });
}

template <class Visit, class Adjustment>
void visit_adjustment(Visit& v, Adjustment& a) {
  v.plain(a.moved), v.plain(a.cost_per_match), v.plain(a.matches), v.plain(a.points);
  v.plain(a.matches_in_newest), v.plain(a.unit_variance);
}

template <class Visit, class Corners>
void visit_corners(Visit& v, Corners& c) {
  v.plain(c.tracks), v.plain(c.agreeing_share), v.plain(c.scale), v.plain(c.scale_sigma);
  v.plain(c.change_10), v.plain(c.change_10_sigma), v.plain(c.change_50), v.plain(c.change_50_sigma);
  v.plain(c.motion_error), v.plain(c.motion_sigma), v.plain(c.motion_error_depths);
  v.plain(c.rotation_deg), v.plain(c.rotation_sigma_deg);
  v.plain(c.direction_deg), v.plain(c.direction_sigma_deg);
}

template <class Visit, class Evidence>
void visit_evidence(Visit& v, Evidence& e) {
  const auto plain = [&](auto& value) { v.plain(value); };
  v.plain(e.edges), v.plain(e.saturated_share), v.plain(e.edge_blur), v.plain(e.median_depth),
      v.plain(e.diverged);
  v.maybe(e.visible_points, plain), v.maybe(e.matched_points, plain);
  v.plain(e.inlier_share), v.plain(e.residual_px);
  visit_numbers(v, e.pose_sigmas);
  v.plain(e.step_sigmas), v.plain(e.stands), v.plain(e.moved_by_map);
  v.maybe(e.known_points, plain), v.plain(e.lacking_share), v.plain(e.view_share);
  v.maybe(e.adjustment, [&](auto& a) { visit_adjustment(v, a); });
  v.plain(e.focal_error), v.plain(e.focal_error_sigma);
  v.maybe(e.unit, [&](auto& u) { v.plain(u.ratio), v.plain(u.sigma); });
  v.maybe(e.corners, [&](auto& c) { visit_corners(v, c); });
}

template <class Visit, class Frame>
void visit_frame(Visit& v, Frame& f) {
  v.plain(f.index), v.plain(f.time), v.plain(f.state), v.plain(f.segment), v.plain(f.is_keyframe);
  v.reason(f.keyframe_reason);
  visit_evidence(v, f.evidence);
  v.plain(f.p_right);
  visit_times(v, f.stage_ms);
  visit_pose(v, f.T_world_cam_live);
  visit_numbers(v, f.covariance);
  v.list(f.reasons, [&](auto& r) { v.plain(r.kind), v.plain(r.value), v.plain(r.other); });
  v.text(f.note);
  v.maybe(f.latency_ms, [&](auto& ms) { v.plain(ms); });
}

template <class Visit, class Line>
void visit_line(Visit& v, Line& line) {
  v.list(line.vertices, [&](auto& p) {
    visit_numbers(v, p.px);
    v.plain(p.idepth), v.plain(p.idepth_sigma), v.plain(p.gray_dark), v.plain(p.gray_bright);
  });
  v.plain(line.keyframes), v.plain(line.views), v.plain(line.source), v.plain(line.is_straight),
      v.plain(line.is_outline);
}

template <class Visit, class Keyframe>
void visit_keyframe(Visit& v, Keyframe& k) {
  v.plain(k.frame_index), v.plain(k.time), v.plain(k.segment), v.pose(k.T_world_cam);
  v.plain(k.is_doubtful);
  v.list(k.points, [&](auto& p) {
    visit_numbers(v, p.px), visit_numbers(v, p.normal);
    v.plain(p.idepth), v.plain(p.idepth_sigma), v.plain(p.observations), v.plain(p.gray);
  });
  v.list(k.lines, [&](auto& line) { visit_line(v, line); });
}

template <class Visit, class Gaussian>
void visit_camera_gaussian(Visit& v, Gaussian& g) {
  visit_numbers(v, g.mean), visit_numbers(v, g.covariance), v.plain(g.keyframes);
}

template <class Visit, class Posterior>
void visit_camera_posterior(Visit& v, Posterior& c) {
  visit_camera_gaussian(v, c.whole), visit_camera_gaussian(v, c.given);
  v.plain(c.applied), v.plain(c.readout_given_s), v.plain(c.is_sought);
  auto& corners = c.corners;
  v.plain(corners.focal), v.plain(corners.sigma), v.plain(corners.windows), v.plain(corners.windows_weighed);
}

template <class Visit, class Correction>
void visit_correction(Visit& v, Correction& c) {
  v.plain(c.k1), v.plain(c.readout_s), v.plain(c.focal);
}

template <class Visit, class Move>
void visit_move(Visit& v, Move& m) {
  v.plain(m.id), v.pose(m.T_cam_newest), v.plain(m.scale_ratio);
  v.list(m.points, [&](auto& p) { visit_numbers(v, p.px), v.plain(p.idepth); });
  visit_numbers(v, m.motion.velocity), visit_numbers(v, m.motion.idepth);
  visit_numbers(v, m.motion.turning);
}

// ---- the events ----

template <class Visit>
void visit(Visit& v, typename Visit::template Value<SegmentPlaced>& e) {
  v.plain(e.segment), visit_similarity(v, e.T_world_map), v.plain(e.method);
  v.plain(e.scale_sigma), v.plain(e.rotation_sigma), v.plain(e.position_sigma);
}

template <class Visit>
void visit(Visit& v, typename Visit::template Value<EpochBegan>& e) {
  v.plain(e.segment), v.plain(e.last_before), v.plain(e.first);
  v.plain(e.unit_sigma), v.plain(e.is_doubted);
}

template <class Visit>
void visit(Visit& v, typename Visit::template Value<ConstraintAdded>& e) {
  auto& c = e.constraint;
  v.plain(e.id), v.node(c.from), v.node(c.to), visit_similarity(v, c.T_from_to);
  visit_numbers(v, c.covariance), v.plain(c.kind), visit_numbers(v, c.centre);
  v.maybe(c.failure, [&](auto& f) { v.plain(f.probability), visit_numbers(v, f.covariance); });
}

template <class Visit>
void visit(Visit& v, typename Visit::template Value<ConstraintWithdrawn>& e) {
  v.plain(e.id);
}

template <class Visit>
void visit(Visit& v, typename Visit::template Value<EpochsPlaced>& e) {
  v.list(e.epochs, [&](auto& p) {
    v.plain(p.segment), v.plain(p.epoch), v.plain(p.first_keyframe);
    visit_similarity(v, p.T_world_map), v.plain(p.scale_sigma);
  });
  v.plain(e.segment), visit_similarity(v, e.T_odom_map), v.pose(e.T_world_odom);
  v.plain(e.newest_constraint);
}

template <class Visit>
void visit(Visit& v, typename Visit::template Value<KeyframeAdded>& e) {
  v.plain(e.id), v.plain(e.frame_index), v.plain(e.segment);
}

template <class Visit>
void visit(Visit& v, typename Visit::template Value<KeyframeMarginalised>& e) {
  v.plain(e.id);
  v.shared(e.keyframe, [&](auto& k) { visit_keyframe(v, k); });
  v.list(e.neighbours,
         [&](auto& n) { v.plain(n.id), v.pose(n.T_leaving_neighbour), visit_numbers(v, n.covariance); });
}

template <class Visit>
void visit(Visit& v, typename Visit::template Value<MapMoved>& e) {
  v.plain(e.reason), v.plain(e.segment), v.pose(e.T_newest_map);
  v.list(e.keyframes, [&](auto& move) { visit_move(v, move); });
  v.maybe(e.lens, [&](auto& lens) { visit_correction(v, lens.before), visit_correction(v, lens.now); });
}

template <class Visit>
void visit(Visit& v, typename Visit::template Value<WindowAdjusted>& e) {
  v.plain(e.moves);
  v.shared(e.keyframes, [&](auto& active) {
    v.list(active, [&](auto& a) { v.plain(a.id), visit_keyframe(v, a.keyframe); });
  });
}

template <class Visit>
void visit(Visit& v, typename Visit::template Value<LinesFinished>& e) {
  v.plain(e.keyframe_id);
  v.list(e.lines, [&](auto& line) { visit_line(v, line); });
}

template <class Visit>
void visit(Visit& v, typename Visit::template Value<CameraEstimated>& e) {
  visit_camera_posterior(v, e.camera);
}

template <class Visit>
void visit(Visit& v, typename Visit::template Value<FrameMapped>& e) {
  v.plain(e.frame_index), visit_times(v, e.times);
  v.maybe(e.adjustment, [&](auto& a) { visit_adjustment(v, a); });
}

template <class Visit>
void visit(Visit& v, typename Visit::template Value<FrameAnchored>& e) {
  visit_frame(v, e.frame);
  v.maybe(e.anchor, [&](auto& a) {
    v.plain(a.keyframe_id), v.pose(a.T_cam_ref), v.pose(a.T_cam_map), v.plain(a.moves);
  });
}

// An event of the alternative `index` of MapEvent, with its default values.
template <size_t... I>
MapEvent blank_event(size_t index, std::index_sequence<I...>) {
  MapEvent event;
  (void)((I == index && (event.emplace<I>(), true)) || ...);
  return event;
}

constexpr size_t kEvents = std::variant_size_v<MapEvent>;

}  // namespace

RecoveryKind kind_of(const MapEvent& event) { return RecoveryKind(kFirstEventRecord + event.index()); }

std::string bytes_of(const RecoveryHeader& header) {
  ByteWriter out;
  Writing v{&out};
  visit_header(v, header);
  return out.bytes();
}

std::string bytes_of(const MapEvent& event) {
  ByteWriter out;
  Writing v{&out};
  std::visit([&](const auto& e) { visit(v, e); }, event);
  return out.bytes();
}

std::optional<RecoveryHeader> read_header(const std::string& content) {
  ByteReader in(content);
  Reading v{&in};
  RecoveryHeader header;
  visit_header(v, header);
  return in.ok() ? std::make_optional(std::move(header)) : std::nullopt;
}

std::optional<MapEvent> read_event(RecoveryKind kind, const std::string& content) {
  if (kind < kFirstEventRecord || kind >= kFirstEventRecord + kEvents) return std::nullopt;
  ByteReader in(content);
  Reading v{&in};
  MapEvent event = blank_event(size_t(kind - kFirstEventRecord), std::make_index_sequence<kEvents>());
  std::visit([&](auto& e) { visit(v, e); }, event);
  return in.ok() ? std::make_optional(std::move(event)) : std::nullopt;
}

}  // namespace edgevo
