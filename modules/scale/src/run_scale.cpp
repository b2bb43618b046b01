// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/run_scale.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "clock_offset.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/scale/ground_height.h"
#include "edgevo/scale/path.h"
#include "edgevo/scale/track_scale.h"
#include "rescale.h"
#include "scale_course.h"
#include "scale_faults.h"

namespace edgevo {
namespace {

SourceSamples samples_of(const Run& run, const Path& path, const ScaleSource& source,
                         const VehicleTracks& tracks, const ScaleParams& params) {
  SourceSamples samples = positions_along(path, source, tracks, run.T_vehicle_cam);
  if (source.kind == ScaleSource::Kind::kCameraHeight) {
    samples.heights = ground_heights(run, path, params);
    std::stable_sort(samples.heights.begin(), samples.heights.end(),
                     [](const HeightSample& a, const HeightSample& b) { return a.distance < b.distance; });
  }
  return samples;
}

// Paths of one unit are linked, those of two segments as well as these are.
std::optional<double> link_sigma(const Run& run, const UnitPath& before, const UnitPath& after) {
  if (after.unit != before.unit || size_t(after.segment) >= run.segments.size()) return std::nullopt;
  const double sigma = run.segments[size_t(after.segment)].scale_sigma;
  return std::isfinite(sigma) ? std::make_optional(sigma) : std::nullopt;
}

std::vector<MeasuredPath> measured_paths(const Run& run, const std::vector<UnitPath>& paths,
                                         const ScaleSources& sources, const VehicleTracks& tracks,
                                         const ScaleParams& params) {
  std::vector<MeasuredPath> measured;
  for (size_t i = 0; i < paths.size(); ++i) {
    MeasuredPath path{&paths[i].path, {}, std::nullopt};
    for (const ScaleSource& source : sources.list)
      path.sources.push_back(samples_of(run, paths[i].path, source, tracks, params));
    if (i > 0) path.link_sigma = link_sigma(run, paths[i - 1], paths[i]);
    measured.push_back(std::move(path));
  }
  return measured;
}

std::map<std::string, ClockOffset> clock_offsets(const Run& run, const std::vector<UnitPath>& paths,
                                                 const ScaleSources& sources, const VehicleTracks& tracks,
                                                 const ScaleParams& params) {
  std::vector<const Path*> all;
  for (const UnitPath& path : paths) all.push_back(&path.path);
  std::map<std::string, ClockOffset> offsets;
  for (const ScaleSource& source : sources.list) {
    const auto track = source.sensor() ? tracks.find(*source.sensor()) : tracks.end();
    if (track == tracks.end()) continue;
    const auto offset =
        clock_offset(all, track->second, sensor_in_camera(track->second, run.T_vehicle_cam), params);
    if (offset) offsets[source.text] = *offset;
  }
  return offsets;
}

VehicleTracks with_stamps_of_camera(const std::map<std::string, ClockOffset>& offsets,
                                    const ScaleSources& sources, VehicleTracks tracks) {
  for (const ScaleSource& source : sources.list)
    if (const auto offset = offsets.find(source.text); offset != offsets.end())
      tracks[*source.sensor()] = corrected(std::move(tracks[*source.sensor()]), offset->second.late_s);
  return tracks;
}

std::string problem_of(const ScaleSource& source) {
  if (source.kind == ScaleSource::Kind::kCameraHeight)
    return "the edges show no ground at one height under the camera's path; give another --scale";
  return "its positions do not fit the path of the camera, or cover too little of it; see `edgevo info`, or "
         "give another --scale";
}

std::string problem_of(const ScaleSources& sources) {
  std::string problem;
  for (const ScaleSource& source : sources.list)
    problem += (problem.empty() ? "" : "; ") + (sources.list.size() > 1 ? source.text + ": " : "") +
               problem_of(source);
  return problem;
}

// Frames without a pose take that of the nearest frame before them, else after.
void fill_gaps(std::vector<ScaleEstimate>* of_frame, const std::vector<bool>& has_pose) {
  const auto first = std::find(has_pose.begin(), has_pose.end(), true) - has_pose.begin();
  ScaleEstimate last = (*of_frame)[size_t(first)];
  for (size_t i = 0; i < of_frame->size(); ++i) {
    if (has_pose[i])
      last = (*of_frame)[i];
    else
      (*of_frame)[i] = {last.factor, last.sigma, 0};
  }
}

// Before the first estimate that estimate; `otherwise` if there is none.
std::vector<double> live_factors(const std::vector<std::optional<ScaleEstimate>>& live, double otherwise,
                                 size_t frames) {
  const auto first = std::find_if(live.begin(), live.end(), [](const auto& e) { return e.has_value(); });
  std::vector<double> factors(frames, first != live.end() ? (*first)->factor : otherwise);
  for (size_t i = 0; i < frames; ++i) {
    if (i < live.size() && live[i])
      factors[i] = live[i]->factor;
    else if (i > 0)
      factors[i] = factors[i - 1];
  }
  return factors;
}

ScaleRecord record_of(const RunScale& scale, const std::vector<std::optional<ScaleEstimate>>& live,
                      const Run& run) {
  ScaleRecord record;
  record.faults = scale.faults;
  record.clock_offsets = scale.clock_offsets;
  std::vector<double> factors, sigmas;
  for (size_t i = 0; i < run.frames.size(); ++i) {
    const ScaleEstimate& e = scale.of_frame[i];
    FrameScale f{e.factor, e.sigma, e.samples, 0, 0};
    if (i < live.size() && live[i]) f.live_factor = live[i]->factor, f.live_sigma = live[i]->sigma;
    record.frames.push_back(f);
    if (!run.frames[i].T_world_cam) continue;
    factors.push_back(e.factor);
    sigmas.push_back(e.sigma);
    record.frames_carried_over += e.samples == 0;
  }
  record.lowest = *std::min_element(factors.begin(), factors.end());
  record.highest = *std::max_element(factors.begin(), factors.end());
  record.factor = median(std::move(factors));
  record.sigma = median(std::move(sigmas));
  return record;
}

}  // namespace

RunScale estimate_run_scale(const Run& run, const ScaleSources& sources, const VehicleTracks& tracks,
                            const ScaleParams& params) {
  RunScale result;
  const std::vector<UnitPath> paths = paths_by_unit(run);
  result.clock_offsets = clock_offsets(run, paths, sources, tracks, params);
  const std::vector<MeasuredPath> measured = measured_paths(
      run, paths, sources, with_stamps_of_camera(result.clock_offsets, sources, tracks), params);
  const ScaleCourse course = solve_scale_course(measured, params);
  if (course.of_path.empty()) {
    result.problem = problem_of(sources);
    return result;
  }
  std::map<int, size_t> place;
  for (size_t i = 0; i < run.frames.size(); ++i) place[run.frames[i].index] = i;
  result.of_frame.assign(run.frames.size(), ScaleEstimate{1, 0, 0});
  std::vector<bool> has_pose(run.frames.size(), false);
  for (size_t p = 0; p < paths.size(); ++p)
    for (size_t i = 0; i < paths[p].path.size(); ++i) {
      const size_t at = place.at(paths[p].path[i].frame_index);
      result.of_frame[at] = course.of_path[p][i], has_pose[at] = true;
    }
  fill_gaps(&result.of_frame, has_pose);
  result.faults = scale_faults(measured, course);
  return result;
}

void make_metric(const RunScale& scale, const std::vector<std::optional<ScaleEstimate>>& live,
                 const ScaleSources& sources, Run* run) {
  run->scale = record_of(scale, live, *run);
  run->scale_source = sources.text;
  std::vector<double> factors;
  for (const ScaleEstimate& e : scale.of_frame) factors.push_back(e.factor);
  rescale_final(factors, run);
  rescale_live(live_factors(live, run->scale.factor, run->frames.size()), run);
}

}  // namespace edgevo
