// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/scale/run_scale.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "edgevo/core/order_statistics.h"
#include "edgevo/core/record_units.h"
#include "edgevo/scale/ground_height.h"
#include "edgevo/scale/path.h"
#include "edgevo/scale/sliding_scale.h"
#include "edgevo/scale/track_scale.h"

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

std::vector<ScaleEstimate> slide_over_ground(const Run& run, int segment, const Path& path,
                                             const ScaleSource& source, const ScaleParams& params) {
  const Eigen::Vector3d down = down_in_camera(run.T_vehicle_cam);
  std::vector<HeightSample> heights;
  for (const KeyframeRecord& k : run.keyframes) {
    if (k.segment != segment) continue;
    const std::vector<HeightSample> more = ground_heights(run.pinhole, k, down, path, true, params);
    heights.insert(heights.end(), more.begin(), more.end());
  }
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

SE3 at(const SE3& T, const Eigen::Vector3d& position) { return {T.rotation(), position}; }

// Rebuilds the path step by step, each step with its own scale.
class Chain {
 public:
  /// The position of the next pose along the path, metres.
  Eigen::Vector3d next(const Eigen::Vector3d& position, double factor) {
    if (is_first_) {
      metres_ = factor * position;
    } else {
      // The scale changes slowly: the mean of both ends is used for the step.
      metres_ += 0.5 * (factor + factor_) * (position - position_);
    }
    is_first_ = false;
    position_ = position;
    factor_ = factor;
    return metres_;
  }

 private:
  bool is_first_ = true;
  double factor_ = 1;
  Eigen::Vector3d position_ = Eigen::Vector3d::Zero(), metres_ = Eigen::Vector3d::Zero();
};

struct Move {  // of one frame
  Eigen::Vector3d from, to;
  double factor;
};

std::map<int, Move> move_frames(const RunScale& scale, Run* run) {
  std::map<int, Move> moves;
  Chain chain;
  for (size_t i = 0; i < run->frames.size(); ++i) {
    FrameRecord& f = run->frames[i];
    const double factor = scale.of_frame[i].factor;
    multiply_lengths(factor, &f);
    if (!f.T_world_cam) continue;
    const Eigen::Vector3d from = f.T_world_cam->translation(), to = chain.next(from, factor);
    f.T_world_cam = at(*f.T_world_cam, to);
    moves[f.index] = {from, to, factor};
  }
  return moves;
}

// The frame of a keyframe, or the last one before it that has a pose.
const Move& move_of(const std::map<int, Move>& moves, int frame_index) {
  const auto after = moves.upper_bound(frame_index);
  return after == moves.begin() ? after->second : std::prev(after)->second;
}

void move_keyframes(const std::map<int, Move>& moves, Run* run) {
  for (KeyframeRecord& k : run->keyframes) {
    const Move& move = move_of(moves, k.frame_index);
    k.T_world_cam = at(k.T_world_cam, move.to + move.factor * (k.T_world_cam.translation() - move.from));
    multiply_depths(move.factor, &k);
  }
}

void move_live(const std::vector<std::optional<ScaleEstimate>>& live, double otherwise, Run* run) {
  const auto first = std::find_if(live.begin(), live.end(), [](const auto& e) { return e.has_value(); });
  double factor = first != live.end() ? (*first)->factor : otherwise;
  Chain chain;
  for (size_t i = 0; i < run->frames.size(); ++i) {
    if (i < live.size() && live[i]) factor = live[i]->factor;
    auto& T = run->frames[i].T_world_cam_live;
    if (T) T = at(*T, chain.next(T->translation(), factor));
  }
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
  const std::vector<Path> paths = paths_of(run);
  for (size_t s = 0; s < paths.size(); ++s) {
    const std::vector<ScaleEstimate> scales = source.sensor()
                                                  ? slide_over_track(run, paths[s], track, params)
                                                  : slide_over_ground(run, int(s), paths[s], source, params);
    for (size_t i = 0; i < scales.size(); ++i) of_frame[place.at(paths[s][i].frame_index)] = scales[i];
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
  const std::map<int, Move> moves = move_frames(scale, run);
  if (!moves.empty()) move_keyframes(moves, run);
  move_live(live, run->scale.factor, run);
}

}  // namespace edgevo
