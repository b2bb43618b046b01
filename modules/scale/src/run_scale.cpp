// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/run_scale.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "edgevo/core/order_statistics.h"
#include "edgevo/scale/ground_height.h"
#include "edgevo/scale/path.h"
#include "edgevo/scale/track_scale.h"
#include "rescale.h"
#include "sliding_scale.h"

namespace edgevo {
namespace {

// The samples within an interval, from a list sorted by travelled distance.
template <class Sample>
std::vector<Sample> in_interval(const std::vector<Sample>& sorted, double begin, double end) {
  const auto first = std::lower_bound(sorted.begin(), sorted.end(), begin,
                                      [](const Sample& s, double w) { return s.distance < w; });
  const auto last =
      std::upper_bound(first, sorted.end(), end, [](double w, const Sample& s) { return w < s.distance; });
  return {first, last};
}

std::vector<ScaleEstimate> slide_over_ground(const Run& run, const Path& path, const ScaleSource& source,
                                             const ScaleParams& params) {
  std::vector<HeightSample> heights = ground_heights(run, path, params);
  std::stable_sort(heights.begin(), heights.end(),
                   [](const HeightSample& a, const HeightSample& b) { return a.distance < b.distance; });
  return slide(path, params.interval, [&](double begin, double end) {
    return fit_height(in_interval(heights, begin, end), source.value, params);
  });
}

std::vector<ScaleEstimate> slide_over_track(const Run& run, const Path& path, const VehicleTrack& track,
                                            const ScaleParams& params) {
  const std::vector<TrackPair> pairs = pair_up(path, track);
  const Eigen::Vector3d sensor = sensor_in_camera(track, run.T_vehicle_cam);
  return slide(path, params.interval, [&](double begin, double end) {
    return fit_track(in_interval(pairs, begin, end), sensor, params);
  });
}

std::string problem_of(const ScaleSource& source) {
  if (source.kind == ScaleSource::Kind::kCameraHeight)
    return "the edges show no ground at one height under the camera's path; give another --scale";
  return "its positions do not fit the path of the camera, or cover too little of it; see `edgevo info`, or "
         "give another --scale";
}

// Frames without an estimate take that of the nearest frame before them, else after.
void carry_over(std::vector<ScaleEstimate>* of_frame) {
  const auto known = [](const ScaleEstimate& e) { return e.samples > 0; };
  const auto first = std::find_if(of_frame->begin(), of_frame->end(), known);
  ScaleEstimate last = *first;
  for (ScaleEstimate& e : *of_frame) {
    if (known(e))
      last = e;
    else
      e = {last.factor, last.sigma, 0};
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

RunScale estimate_run_scale(const Run& run, const ScaleSource& source, const VehicleTrack& track,
                            const ScaleParams& params) {
  RunScale result;
  std::vector<ScaleEstimate> of_frame(run.frames.size(), ScaleEstimate{1, 0, 0});
  std::map<int, size_t> place;
  for (size_t i = 0; i < run.frames.size(); ++i) place[run.frames[i].index] = i;
  bool any = false;
  for (const UnitPath& of_unit : paths_by_unit(run)) {
    const Path& path = of_unit.path;
    const std::vector<ScaleEstimate> scales = source.sensor() ? slide_over_track(run, path, track, params)
                                                              : slide_over_ground(run, path, source, params);
    for (size_t i = 0; i < scales.size(); ++i) of_frame[place.at(path[i].frame_index)] = scales[i];
    any |= !scales.empty();
  }
  if (!any) {
    result.problem = problem_of(source);
    return result;
  }
  carry_over(&of_frame);
  result.of_frame = std::move(of_frame);
  return result;
}

void make_metric(const RunScale& scale, const std::vector<std::optional<ScaleEstimate>>& live,
                 const ScaleSource& source, Run* run) {
  run->scale = record_of(scale, live, *run);
  run->scale_source = source.text;
  std::vector<double> factors;
  for (const ScaleEstimate& e : scale.of_frame) factors.push_back(e.factor);
  rescale_final(factors, run);
  rescale_live(live_factors(live, run->scale.factor, run->frames.size()), run);
}

}  // namespace edgevo
