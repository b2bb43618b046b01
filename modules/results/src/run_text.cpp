// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/run_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include "edgevo/core/output_file.h"
#include "edgevo/mrpt_bridge/playback_pose.h"
#include "edgevo/run_quality/run_statistics.h"

namespace edgevo {
namespace {

// A nanometre of a position in metres, a nanoradian of a rotation.
constexpr int kDecimals = 9;

const std::optional<SE3>& pose_of(const FrameRecord& frame, PoseKind kind) {
  return kind == PoseKind::kFinal ? frame.T_world_cam : frame.T_world_cam_live;
}

bool is_usable(const std::optional<SE3>& T) { return T && T->is_finite(); }

std::string one_cell(std::string note) {
  std::replace(note.begin(), note.end(), ',', ';');
  std::replace(note.begin(), note.end(), '"', '\'');
  std::replace_if(
      note.begin(), note.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return note;
}

// ---- cells of the evidence, each after a comma; empty: unknown ----

void append_number(std::string* text, double value, int decimals) {
  *text += ',';
  if (std::isfinite(value)) append_fixed(text, value, decimals);
}

void append_count(std::string* text, const std::optional<int>& count) {
  *text += ',';
  if (count) *text += std::to_string(*count);
}

void append_adjustment(std::string* text, const std::optional<AdjustmentEvidence>& adjustment) {
  if (!adjustment) {
    *text += ",,,,,,";
    return;
  }
  append_number(text, adjustment->moved, 4);
  append_number(text, adjustment->cost_per_match, 4);
  for (const int count : {adjustment->matches, adjustment->points, adjustment->matches_in_newest})
    append_count(text, count);
  append_number(text, std::sqrt(adjustment->unit_variance), 4);
}

void append_corners(std::string* text, const CornerEvidence& c) {
  append_number(text, c.agreeing_share, 3);
  for (const double value :
       {c.scale, c.scale_sigma, c.change_10, c.change_10_sigma, c.change_50, c.change_50_sigma,
        c.motion_error, c.motion_sigma, c.motion_error_depths, c.rotation_deg, c.rotation_sigma_deg})
    append_number(text, value, 4);
  append_number(text, c.direction_deg, 2);
  append_number(text, c.direction_sigma_deg, 2);
}

void append_unit(std::string* text, const std::optional<RelativeScale>& unit) {
  append_count(text, unit ? std::optional<int>(unit->is_linked()) : std::nullopt);
  const RelativeScale compared = unit.value_or(RelativeScale());
  append_number(text, compared.ratio, 4);
  append_number(text, compared.sigma, 4);
}

void append_evidence(std::string* text, const FrameEvidence& e) {
  append_count(text, e.visible_points);
  append_count(text, e.matched_points);
  append_number(text, e.pose_sigmas.back(), 6);
  append_number(text, e.step_sigmas, 3);
  append_count(text, e.known_points);
  append_number(text, e.lacking_share, 4);
  append_number(text, e.view_share, 4);
  append_number(text, e.saturated_share, 4);
  append_number(text, e.edge_blur, 3);
  append_number(text, e.median_depth, 6);
  append_adjustment(text, e.adjustment);
  append_count(text, e.corners ? std::optional<int>(e.corners->tracks) : std::nullopt);
  append_corners(text, e.corners.value_or(CornerEvidence()));
  append_number(text, e.focal_error, 4);
  append_number(text, e.focal_error_sigma, 4);
  append_unit(text, e.unit);
}

}  // namespace

std::string tum_line(Timestamp time, const SE3& T) {
  std::string text = to_string(time);
  for (int i = 0; i < 3; ++i) append_fixed(&(text += ' '), T.translation()[i], kDecimals);
  const Eigen::Vector4d q = T.rotation().coeffs() * (T.rotation().w() < 0 ? -1 : 1);
  for (int i = 0; i < 4; ++i) append_fixed(&(text += ' '), q[i], kDecimals);
  return text + '\n';
}

std::string frames_csv_row(const FrameRecord& frame, const std::vector<std::string>& stages) {
  std::string text = std::to_string(frame.index) + ',' + to_string(frame.time) + ',' +
                     std::string(to_string(frame.state)) + ',' + std::to_string(frame.segment) + ',' +
                     (frame.is_keyframe ? '1' : '0') + ',';
  append_fixed(&text, frame.evidence.inlier_share, 4);
  append_fixed(&(text += ','), frame.evidence.residual_px, 4);
  text += ',' + std::to_string(frame.evidence.edges) + ',' + one_cell(frame.note) + ',' +
          std::string(to_string(frame.keyframe_reason)) + ',';
  if (frame.latency_ms) append_fixed(&text, *frame.latency_ms, 3);
  append_evidence(&text, frame.evidence);
  append_number(&text, frame.p_right, 4);
  text += frame.is_doubtful_keyframe ? ",1" : ",0";
  text += frame.evidence.stands ? ",1" : ",0";
  text += frame.T_world_cam_live && std::isnan(frame.p_right) ? ",1" : ",0";
  for (const std::string& stage : stages) {
    text += ',';
    const auto ran = std::find_if(frame.stage_ms.begin(), frame.stage_ms.end(),
                                  [&](const auto& s) { return s.first == stage; });
    if (ran != frame.stage_ms.end()) append_fixed(&text, ran->second, 3);
  }
  return text + '\n';
}

std::string trajectory_tum(const Run& run, PoseKind kind) {
  std::string text =
      kind == PoseKind::kFinal
          ? "# edgevo: T_world_cam of each frame that has a pose, re-expressed from the final keyframe "
            "poses\n"
          : "# edgevo: T_world_cam of each frame that had a pose, as it was known when the frame came\n";
  text +=
      "# axes: camera x right, y down, z forward; world: those of the first camera\n"
      "# unit: " +
      unit_statement(run) +
      "\n"
      "# t tx ty tz qx qy qz qw\n";
  for (const FrameRecord& frame : run.frames)
    if (const auto& T = pose_of(frame, kind); is_usable(T)) text += tum_line(frame.time, *T);
  return text;
}

std::string trajectory_vehicle_tum(const Run& run) {
  std::string text =
      "# edgevo: pose of the vehicle at each frame that has a pose, re-expressed from the final keyframe "
      "poses\n"
      "# axes: x forward, y left, z up; world: those of the vehicle at the first pose\n"
      "# unit: " +
      unit_statement(run) +
      (run.is_metric() ? ""
                       : "; without it the distance of the camera from the vehicle's origin is left out") +
      "\n"
      "# t tx ty tz qx qy qz qw\n";
  for (const FrameRecord& frame : run.frames)
    if (is_usable(frame.T_world_cam)) text += tum_line(frame.time, T_map_vehicle(run, *frame.T_world_cam));
  return text;
}

std::string trajectory_kitti(const Run& run) {
  std::string text;
  SE3 T;
  for (const FrameRecord& frame : run.frames) {
    if (is_usable(frame.T_world_cam)) T = *frame.T_world_cam;
    const Eigen::Matrix4d m = T.matrix();
    for (int i = 0; i < 12; ++i) {
      if (i > 0) text += ' ';
      append_fixed(&text, m(i / 4, i % 4), kDecimals);
    }
    text += '\n';
  }
  return text;
}

std::string frames_csv(const Run& run) {
  const std::vector<std::string> stages = stages_of(run);
  std::string text =
      "index,time,state,segment,keyframe,inlier_share,residual_px,edges,note,keyframe_rule,latency_ms,"
      "visible_points,matched_points,pose_sigma,step_sigmas,known_points,lacking_share,view_share,"
      "saturated_share,edge_blur,median_depth,adjusted_move,adjusted_cost,adjusted_matches,adjusted_points,"
      "adjusted_here,adjusted_unit_sigma,corners,corners_agreeing,corner_scale,corner_scale_sigma,corner_"
      "change_10,"
      "corner_change_10_sigma,corner_change_50,corner_change_50_sigma,corner_motion,corner_motion_sigma,"
      "corner_motion_depths,corner_rotation_deg,corner_rotation_sigma,corner_direction_deg,"
      "corner_direction_sigma,focal_error,focal_error_sigma,unit_linked,unit_ratio,unit_sigma,p_right,"
      "keyframe_doubtful,stands,posed_later";
  for (const std::string& stage : stages) text += ",ms_" + one_cell(stage);
  text += '\n';
  for (const FrameRecord& frame : run.frames) text += frames_csv_row(frame, stages);
  return text;
}

namespace {

void append_scientific(std::string* text, double value) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::scientific, 6);
  *text += ',';
  text->append(buffer, end.ptr);
}

bool has_covariance(const FrameRecord& f) {
  return f.T_world_cam && f.reference_keyframe >= 0 && f.covariance.allFinite() && !f.covariance.isZero(0);
}

}  // namespace

std::string covariances_csv(const Run& run) {
  std::string text = "index,reference";
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) text += ",c" + std::to_string(i) + std::to_string(j);
  text += '\n';
  for (const FrameRecord& f : run.frames) {
    if (!has_covariance(f)) continue;
    text += std::to_string(f.index) + ',' +
            std::to_string(run.keyframes[size_t(f.reference_keyframe)].frame_index);
    for (int i = 0; i < 6; ++i)
      for (int j = i; j < 6; ++j) append_scientific(&text, f.covariance(i, j));
    text += '\n';
  }
  return text;
}

std::string graph_csv(const Run& run) {
  std::string text = "what,segment,epoch,first_frame,last_frame,scale,sigma,holds\n";
  const auto append = [&](const std::string& begin, int first, int last, double scale, double sigma) {
    text += begin + std::to_string(first) + ',' + std::to_string(last) + ',';
    if (std::isfinite(sigma)) append_fixed(&text, scale, 6);
    text += ',';
    if (std::isfinite(sigma)) append_fixed(&text, sigma, 5);
    text += ',';
  };
  for (const EpochRecord& e : run.epochs) {
    append("epoch," + std::to_string(e.segment) + ',' + std::to_string(e.epoch) + ',', e.first_frame,
           e.last_frame, e.scale, e.scale_sigma);
    text += '\n';
  }
  for (const ConstraintRecord& c : run.constraints) {
    append(c.kind + ",,,", c.from_frame, c.to_frame, c.scale, c.scale_sigma);
    text += std::to_string(int(c.holds)) + '\n';
  }
  return text;
}

std::string scale_csv(const Run& run) {
  std::string text = "index,time,factor,sigma,samples,live_factor,live_sigma\n";
  for (size_t i = 0; i < run.scale.frames.size(); ++i) {
    const FrameScale& s = run.scale.frames[i];
    text += std::to_string(run.frames[i].index) + ',' + to_string(run.frames[i].time) + ',';
    append_fixed(&text, s.factor, 6);
    append_fixed(&(text += ','), s.sigma, 5);
    text += ',' + std::to_string(s.samples) + ',';
    if (s.live_factor > 0) {
      append_fixed(&text, s.live_factor, 6);
      append_fixed(&(text += ','), s.live_sigma, 5);
    } else {
      text += ',';
    }
    text += '\n';
  }
  return text;
}

}  // namespace edgevo
