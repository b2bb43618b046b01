#include "summary.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "edgevo/core/output_file.h"
#include "edgevo/report/latency_figures.h"
#include "edgevo/report/stage_times.h"
#include "edgevo/results/yaml_writer.h"
#include "edgevo_build_info.h"

namespace edgevo {
namespace {

void write_versions(YamlWriter* y) {
  y->open("edgevo");
  y->text("version", build_info::kVersion);
  y->text("git", build_info::kGitHash);
  y->text("build_type", build_info::kBuildType);
  y->text("compiler", build_info::kCompiler);
  y->close();
  y->open("libraries");
  y->text("mrpt", build_info::kMrpt);
  y->text("opencv", build_info::kOpenCv);
  y->text("ceres", build_info::kCeres);
  y->text("octomap", build_info::kOctomap);
  y->text("eigen", build_info::kEigen);
  y->close();
}

void write_source(const RunInfo& info, YamlWriter* y) {
  std::string command;
  for (const std::string& word : info.command_line) command += (command.empty() ? "" : " ") + word;
  y->text("command", command);
  y->open("source");
  y->text("kind", info.source_kind);
  y->text("path", info.source_path);
  y->boolean("interrupted", info.interrupted);
  y->close();
}

std::string calibration_statement(const CameraRefinement& c) {
  using State = CameraRefinement::State;
  switch (c.state) {
    case State::kOff: return "off: the camera file was taken as it is";
    case State::kTooEarly: return "the run was too short to tell";
    case State::kNotObservable: return "the motion was too straight, too still or too short to tell";
    case State::kInsignificant: return "no significant residual distortion: the camera file was left alone";
    case State::kApplied: return "applied: images and map are corrected by residual_k1";
  }
  return "";
}

std::string shutter_statement(const CameraRefinement::Shutter& s) {
  using State = CameraRefinement::State;
  switch (s.state) {
    case State::kOff: return s.readout_s != 0 ? "off: readout_s was taken as given" : "off: rows were taken as all of one moment";
    case State::kTooEarly: return "the run was too short to tell";
    case State::kNotObservable: return "the motion was too still or too short to tell";
    case State::kInsignificant: return "no significant read-out time: a global shutter, or a fast one";
    case State::kApplied: return "rolling: the rows of the images are put where the moment of the middle row has them";
  }
  return "";
}

// x_file = x (1 + residual_k1 r^2): before the file's own distortion. Row v is taken readout_s (v / (height - 1) - 1/2) after the middle.
void write_self_calibration(const CameraRefinement& c, YamlWriter* y) {
  y->open("self_calibration");
  y->text("state", to_string(c.state));
  y->text("result", calibration_statement(c));
  y->number("residual_k1", c.k1, 5);
  if (c.sigma > 0) {
    y->number("estimate", c.estimate, 5);
    y->number("standard_deviation", c.sigma, 4);
    y->integer("keyframes", c.keyframes);
  }
  const CameraRefinement::Shutter& s = c.shutter;
  y->text("shutter", to_string(s.state));
  y->text("shutter_result", shutter_statement(s));
  y->number("readout_s", s.readout_s, 5);
  if (s.sigma > 0) {
    y->number("readout_estimate", s.estimate, 5);
    y->number("readout_standard_deviation", s.sigma, 4);
    y->integer("readout_keyframes", s.keyframes);
  }
  y->close();
}

void write_camera(const Camera& camera, YamlWriter* y) {
  const Pinhole& p = camera.pinhole;
  const Distortion& d = camera.distortion;
  y->open("camera");
  y->integer("width", p.width);
  y->integer("height", p.height);
  for (const auto& [key, value] : {std::pair("fx", p.fx),
                                   {"fy", p.fy},
                                   {"cx", p.cx},
                                   {"cy", p.cy},
                                   {"k1", d.k1},
                                   {"k2", d.k2},
                                   {"p1", d.p1},
                                   {"p2", d.p2},
                                   {"k3", d.k3}})
    y->number(key, value, 9);
  y->close();
}

void write_scale(const Run& run, YamlWriter* y) {
  y->open("scale");
  y->text("source", run.scale_source);
  y->boolean("metric", run.is_metric());
  y->text("unit", unit_statement(run));
  if (run.is_metric()) {
    y->number("metres_per_unit", run.scale.factor, 6);
    y->number("relative_standard_deviation", run.scale.sigma, 5);
    y->number("lowest", run.scale.lowest, 6);
    y->number("highest", run.scale.highest, 6);
    y->integer("frames_not_measured", run.scale.frames_carried_over);
  }
  if (!run.scale.problem.empty()) y->text("problem", run.scale.problem);
  y->close();
}

int with_pose(const Run& run) {
  return int(std::count_if(run.frames.begin(), run.frames.end(),
                           [](const auto& f) { return f.T_world_cam.has_value(); }));
}

void write_frames(const Run& run, YamlWriter* y) {
  const auto in_state = [&](TrackingState s) {
    return std::count_if(run.frames.begin(), run.frames.end(), [&](const auto& f) { return f.state == s; });
  };
  const int posed = with_pose(run);
  y->open("frames");
  y->integer("total", long(run.frames.size()));
  y->integer("bootstrapping", in_state(TrackingState::kBootstrapping));
  y->integer("tracking", in_state(TrackingState::kTracking));
  y->integer("degraded", in_state(TrackingState::kDegraded));
  y->integer("lost", in_state(TrackingState::kLost));
  y->integer("with_pose", posed);
  y->number("coverage", run.frames.empty() ? 0.0 : double(posed) / double(run.frames.size()), 4);
  y->close();
}

// Sum of the steps within segments.
double path_length(const Run& run) {
  double length = 0;
  const FrameRecord* last = nullptr;
  for (const FrameRecord& frame : run.frames) {
    if (!frame.T_world_cam) continue;
    if (last && last->segment == frame.segment)
      length += (frame.T_world_cam->translation() - last->T_world_cam->translation()).norm();
    last = &frame;
  }
  return length;
}

void write_trajectory(const Run& run, YamlWriter* y) {
  std::set<int> segments;
  for (const FrameRecord& frame : run.frames)
    if (frame.segment >= 0) segments.insert(frame.segment);
  y->open("trajectory");
  y->integer("segments", long(segments.size()));
  y->integer("keyframes", long(run.keyframes.size()));
  y->number("path_length", path_length(run), 6);
  y->close();
}

void write_map(const Run& run, const MapReport& report, YamlWriter* y) {
  const OctreeStats& map = report.octree;
  const OccupancyGrid none;
  const OccupancyGrid& grid = report.grid ? *report.grid : none;
  y->open("map");
  y->text("axes", "x forward, y left, z up");
  y->text("up", run.T_vehicle_cam ? "of the vehicle (mount given by the source)"
                                  : "of the first camera, taken to look ahead");
  y->integer("points", map.points.total);
  y->integer("points_exported", map.points.kept);
  y->integer("points_invalid", map.points.invalid);
  y->integer("points_uncertain", map.points.uncertain);
  y->integer("points_unconfirmed", map.points.unconfirmed);
  y->number("median_depth", map.median_depth, 6);
  y->number("voxel_size", map.resolution, 6);
  y->number("voxel_range", map.max_range, 6);
  y->integer("voxel_points_beyond_range", map.beyond_range);
  y->integer("voxel_points_out_of_bounds", map.out_of_bounds);
  y->integer("voxel_rays", map.rays);
  y->integer("voxels_occupied", map.occupied_voxels);
  y->integer("voxels_free", map.free_voxels);
  y->text("grid", grid.statement);
  y->integer("grid_width", grid.width);
  y->integer("grid_height", grid.height);
  if (map.points.kept == 0) y->text("note", "no point passed the filter: the map files are valid but empty");
  y->close();
}

void write_stage(const std::string& stage, std::vector<double> ms, YamlWriter* y) {
  std::sort(ms.begin(), ms.end());
  double sum = 0;
  for (double v : ms) sum += v;
  y->open(stage);
  y->integer("frames", long(ms.size()));
  y->number("mean", sum / double(ms.size()), 3);
  y->number("median", percentile(ms, 0.5), 3);
  y->number("p95", percentile(ms, 0.95), 3);
  y->number("max", ms.back(), 3);
  y->close();
}

void write_stages(const Run& run, YamlWriter* y) {
  const auto stages = stage_times(run);
  if (stages.empty()) return;  // MRPT's YAML reader refuses a key without a value
  y->open("stages_ms");
  for (const auto& [name, ms] : stages) write_stage(name, ms, y);
  y->close();
}

void write_realtime(const Run& run, YamlWriter* y) {
  if (!run.realtime) return;
  const RealtimeRecord& r = *run.realtime;
  y->open("realtime");
  y->text("pace", r.pace);
  y->number("frames_per_second", r.frames_per_second, 3);
  y->integer("handed_over", r.handed_over);
  y->integer("late", r.late);
  y->integer("dropped", r.dropped);
  y->integer("left_out_of_mapping", r.left_out_of_mapping);
  if (const auto latency = latency_figures(run)) {
    y->open("latency_ms");
    for (const auto& [name, ms] : {std::pair("p50", latency->p50), {"p95", latency->p95}, {"p99", latency->p99}, {"max", latency->max}})
      y->number(name, ms, 3);
    y->close();
  }
  y->close();
}

void write_timing(const SummaryInput& input, YamlWriter* y) {
  const double frames = std::max<double>(1, double(input.run.frames.size()));
  y->open("timing");
  y->number("wall_s", input.use.wall_s, 3);
  y->number("wall_ms_per_frame", 1000 * input.use.wall_s / frames, 3);
  y->number("cpu_ms_per_frame", 1000 * input.use.cpu_s / frames, 3);
  y->number("outputs_wall_s", input.use_with_outputs.wall_s - input.use.wall_s, 3);
  write_stages(input.run, y);
  y->close();
  y->open("memory");
  y->number("peak_mb", input.use_with_outputs.peak_memory_mb, 1);
  y->close();
}

}  // namespace

std::string summary_yaml(const SummaryInput& input) {
  YamlWriter y;
  write_versions(&y);
  write_source(input.info, &y);
  write_camera(input.info.camera, &y);
  write_self_calibration(input.run.camera, &y);
  write_scale(input.run, &y);
  write_frames(input.run, &y);
  write_trajectory(input.run, &y);
  write_map(input.run, input.map, &y);
  write_timing(input, &y);
  write_realtime(input.run, &y);
  y.list("not_written", input.not_written);
  if (!input.info.notes.empty()) y.open("notes");
  for (const auto& [key, value] : input.info.notes) y.text(key, value);
  if (!input.info.notes.empty()) y.close();
  y.block("parameters", input.info.params_yaml);
  return y.str();
}

}  // namespace edgevo
