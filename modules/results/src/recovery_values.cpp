// SPDX-License-Identifier: BSD-3-Clause
#include "recovery_values.h"

// The fields of each type are listed once, in visit_*(); writing and reading share that list.
namespace edgevo {
namespace {

struct Writing {
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
};

struct Reading {
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
    const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
    if (q.norm() > 0) T = SE3(q, Eigen::Vector3d(v[0], v[1], v[2]));
  }
  template <class T, class Each>
  void list(std::vector<T>& values, const Each& each) {
    for (auto left = in->value<uint32_t>(); left > 0 && in->ok(); --left) each(values.emplace_back());
  }
  template <class T, class Each>
  void maybe(std::optional<T>& value, const Each& each) {
    if (in->value<bool>()) each(value.emplace());
  }
};

template <class Visit, class Vector>
void visit_numbers(Visit& v, Vector& numbers) {
  for (int i = 0; i < int(numbers.size()); ++i) v.plain(numbers.data()[i]);
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
  v.text(info.params_yaml);
  v.list(info.notes, [&](auto& note) { v.text(note.first), v.text(note.second); });
}

template <class Visit, class Track>
void visit_track(Visit& v, Track& track) {
  v.list(track.positions, [&](auto& p) { v.plain(p.time), visit_numbers(v, p.position); });
  visit_numbers(v, track.sensor_on_vehicle);
}

template <class Visit, class Header>
void visit_header(Visit& v, Header& header) {
  visit_info(v, header.info);
  v.text(header.scale);
  visit_track(v, header.track);
  visit_pose(v, header.T_vehicle_cam);
}

template <class Visit, class Frame>
void visit_frame(Visit& v, Frame& f) {
  v.plain(f.index), v.plain(f.time), v.plain(f.state), v.plain(f.segment), v.plain(f.is_keyframe);
  v.reason(f.keyframe_reason);
  v.plain(f.inlier_share), v.plain(f.residual_px), v.plain(f.edges);
  v.list(f.stage_ms, [&](auto& stage) { v.text(stage.first), v.plain(stage.second); });
  visit_pose(v, f.T_world_cam_live);
  visit_numbers(v, f.covariance);
  v.text(f.note);
  v.maybe(f.latency_ms, [&](auto& ms) { v.plain(ms); });
}

template <class Visit, class Line>
void visit_line(Visit& v, Line& line) {
  v.list(line.vertices, [&](auto& p) {
    visit_numbers(v, p.px);
    v.plain(p.idepth), v.plain(p.idepth_sigma), v.plain(p.gray_dark), v.plain(p.gray_bright);
  });
  v.plain(line.keyframes), v.plain(line.is_straight), v.plain(line.is_outline);
}

template <class Visit, class Keyframe>
void visit_keyframe(Visit& v, Keyframe& k) {
  v.plain(k.frame_index), v.plain(k.time), v.plain(k.segment), v.pose(k.T_world_cam);
  v.list(k.points, [&](auto& p) {
    visit_numbers(v, p.px), visit_numbers(v, p.normal);
    v.plain(p.idepth), v.plain(p.idepth_sigma), v.plain(p.observations), v.plain(p.gray);
  });
  v.list(k.lines, [&](auto& line) { visit_line(v, line); });
}

template <class Visit, class Refinement>
void visit_refinement(Visit& v, Refinement& c) {
  v.plain(c.state), v.plain(c.k1), v.plain(c.estimate), v.plain(c.sigma), v.plain(c.keyframes);
  auto& s = c.shutter;
  v.plain(s.state), v.plain(s.readout_s), v.plain(s.estimate), v.plain(s.sigma), v.plain(s.keyframes);
}

}  // namespace

void write_value(const RecoveryHeader& header, ByteWriter* out) {
  Writing v{out};
  visit_header(v, header);
}
void write_value(const FrameRecord& frame, ByteWriter* out) {
  Writing v{out};
  visit_frame(v, frame);
}
void write_value(const KeyframeRecord& keyframe, ByteWriter* out) {
  Writing v{out};
  visit_keyframe(v, keyframe);
}
void write_value(const CameraRefinement& camera, ByteWriter* out) {
  Writing v{out};
  visit_refinement(v, camera);
}
void write_value(const std::vector<KeyframeRecord>& keyframes, ByteWriter* out) {
  Writing v{out};
  v.list(keyframes, [&](const KeyframeRecord& k) { visit_keyframe(v, k); });
}

void read_value(ByteReader* in, RecoveryHeader* header) {
  Reading v{in};
  visit_header(v, *header);
}
void read_value(ByteReader* in, FrameRecord* frame) {
  Reading v{in};
  visit_frame(v, *frame);
}
void read_value(ByteReader* in, KeyframeRecord* keyframe) {
  Reading v{in};
  visit_keyframe(v, *keyframe);
}
void read_value(ByteReader* in, CameraRefinement* camera) {
  Reading v{in};
  visit_refinement(v, *camera);
}
void read_value(ByteReader* in, std::vector<KeyframeRecord>* keyframes) {
  Reading v{in};
  v.list(*keyframes, [&](KeyframeRecord& k) { visit_keyframe(v, k); });
}

}  // namespace edgevo
