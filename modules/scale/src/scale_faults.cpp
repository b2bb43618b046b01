// SPDX-License-Identifier: BSD-3-Clause
#include "scale_faults.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "changed_interval.h"

namespace edgevo {
namespace {

using Measurements = std::vector<const IntervalMeasurement*>;

Measurements of_source(const ScaleCourse& course, size_t path, size_t source) {
  Measurements found;
  for (const IntervalMeasurement& m : course.measurements)
    if (m.path == path && m.source == source) found.push_back(&m);
  return found;
}

// ---- lengths that are wrong ----

double factor_at(const std::vector<ScaleEstimate>& scales, const Path& path, double distance) {
  const auto pose = std::lower_bound(path.begin(), path.end(), distance,
                                     [](const PathPose& p, double d) { return p.distance < d; });
  return scales[std::min(size_t(pose - path.begin()), scales.size() - 1)].factor;
}

ScaleFault between(const SourceSamples& samples, const Path& path, double begin, double end) {
  ScaleFault fault;
  fault.source = samples.source.text;
  fault.first_frame = path.back().frame_index, fault.last_frame = path.front().frame_index;
  for (const PathPose& pose : path) {
    if (pose.distance < begin || pose.distance > end) continue;
    fault.first_frame = std::min(fault.first_frame, pose.frame_index);
    fault.last_frame = std::max(fault.last_frame, pose.frame_index);
  }
  return fault;
}

// The mean over measurements that contradict the rest.
void set_excess(const Measurements& failed, ScaleFault* fault) {
  double sum = 0, weights = 0;
  for (const IntervalMeasurement* m : failed) {
    const double weight = 1 / (m->log_excess_sigma * m->log_excess_sigma);
    sum += weight * m->log_excess, weights += weight;
  }
  fault->log_excess = sum / weights;
  // Neighbours share half their samples: no more certain than one of them.
  fault->log_excess_sigma = failed.front()->log_excess_sigma;
  for (const IntervalMeasurement* m : failed)
    fault->log_excess_sigma = std::min(fault->log_excess_sigma, m->log_excess_sigma);
}

// Steps of the sensor along those of the path, and these in metres.
struct Steps {
  std::vector<Eigen::Vector3d> excess;  // its first component
  std::vector<double> along, metres;
  std::vector<int> first_frame, last_frame;
};
Steps steps_of(const SourceSamples& samples, const MeasuredPath& path,
               const std::vector<ScaleEstimate>& scales, const Measurements& failed) {
  Steps steps;
  for (size_t i = 1; i < samples.pairs.size(); ++i) {
    const TrackPair &a = samples.pairs[i - 1], &b = samples.pairs[i];
    if (a.distance < failed.front()->begin || b.distance > failed.back()->end) continue;
    const auto nearest = std::min_element(failed.begin(), failed.end(), [&](const auto* m, const auto* n) {
      return std::abs(m->begin + m->end - 2 * b.distance) < std::abs(n->begin + n->end - 2 * b.distance);
    });
    const Eigen::Vector3d step = b.T_world_cam.translation() - a.T_world_cam.translation();
    const double metres = factor_at(scales, *path.path, b.distance) * step.norm();
    const double along =
        step.norm() > 0 ? ((*nearest)->fit.R_sensor_world * step.normalized()).dot(b.position - a.position)
                        : 0;
    steps.excess.emplace_back(along - metres, 0, 0);
    steps.along.push_back(along), steps.metres.push_back(metres);
    steps.first_frame.push_back(a.frame_index), steps.last_frame.push_back(b.frame_index);
  }
  return steps;
}

// The part of the failed intervals in which the steps differ most from the others, if most of what the
// intervals are too long or too short by is there.
void narrow_down(const Steps& steps, ScaleFault* fault) {
  if (steps.excess.empty()) return;
  const IndexInterval worst = changed_interval(steps.excess);
  if (!stands_out(worst, steps.excess)) return;
  double along = 0, metres = 0, all = 0;
  for (size_t i = worst.begin; i < worst.end; ++i) along += steps.along[i], metres += steps.metres[i];
  for (const Eigen::Vector3d& excess : steps.excess) all += excess.x();
  const double there = along - metres;
  if (!(along > 0) || !(metres > 0) || there * all < 0 || std::abs(there) < std::abs(all) / 2) return;
  fault->log_excess = std::log(along / metres);
  fault->first_frame = steps.first_frame[worst.begin], fault->last_frame = steps.last_frame[worst.end - 1];
}

void add_wrong_lengths(const MeasuredPath& path, const std::vector<ScaleEstimate>& scales, size_t source,
                       const Measurements& measured, std::vector<ScaleFault>* faults) {
  const SourceSamples& samples = path.sources[source];
  for (size_t i = 0; i < measured.size();) {
    Measurements failed;
    for (; i < measured.size() && !measured[i]->holds; ++i) failed.push_back(measured[i]);
    if (failed.empty()) {
      ++i;
      continue;
    }
    ScaleFault fault = between(samples, *path.path, failed.front()->zone_begin, failed.back()->zone_end);
    set_excess(failed, &fault);
    if (failed.size() < measured.size()) narrow_down(steps_of(samples, path, scales, failed), &fault);
    faults->push_back(fault);
  }
}

// ---- positions that are displaced ----

// Each in the zone of one measurement: its neighbours see it, too.
std::vector<TrackJump> jumps_of(const SourceSamples& samples, const Measurements& measured) {
  std::vector<TrackJump> jumps;
  for (const IntervalMeasurement* m : measured)
    for (const TrackJump& jump : m->fit.jumps) {
      const double at = samples.pairs[jump.at].distance;
      if (at >= m->zone_begin && at < m->zone_end) jumps.push_back(jump);
    }
  return jumps;
}

// Between two jumps the positions have one offset against those before the first.
struct Level {
  size_t begin = 0, end = 0;  // pairs
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();
};
std::vector<Level> levels_of(const std::vector<TrackJump>& jumps, size_t pairs) {
  std::vector<Level> levels{{0, pairs, Eigen::Vector3d::Zero()}};
  for (const TrackJump& jump : jumps) {
    if (jump.at <= levels.back().begin) continue;  // found by two neighbours
    levels.back().end = jump.at;
    levels.push_back({jump.at, pairs, levels.back().offset + jump.by});
  }
  return levels;
}

void add_displaced(const SourceSamples& samples, const Measurements& measured,
                   std::vector<ScaleFault>* faults) {
  const std::vector<TrackJump> jumps = jumps_of(samples, measured);
  const std::vector<Level> levels = levels_of(jumps, samples.pairs.size());
  const auto longest = std::max_element(levels.begin(), levels.end(), [](const Level& a, const Level& b) {
    return a.end - a.begin < b.end - b.begin;
  });
  double smallest_jump = std::numeric_limits<double>::infinity();
  for (const TrackJump& jump : jumps) smallest_jump = std::min(smallest_jump, jump.by.norm());
  for (const Level& level : levels) {
    const double displacement = (level.offset - longest->offset).norm();
    if (!(displacement > smallest_jump / 2)) continue;  // back where it was
    ScaleFault fault;
    fault.source = samples.source.text;
    fault.first_frame = samples.pairs[level.begin].frame_index;
    fault.last_frame = samples.pairs[level.end - 1].frame_index;
    fault.displacement = displacement;
    faults->push_back(fault);
  }
}

// The place between the nearest positions before and after one that are not scattered.
Eigen::Vector3d between_neighbours(const SourceSamples& samples, const std::vector<size_t>& scattered,
                                   size_t at) {
  const auto is_scattered = [&](size_t i) {
    return std::binary_search(scattered.begin(), scattered.end(), i);
  };
  size_t before = at, after = at;
  while (before > 0 && is_scattered(before)) --before;
  while (after + 1 < samples.pairs.size() && is_scattered(after)) ++after;
  if (is_scattered(before)) before = after;
  if (is_scattered(after)) after = before;
  return (samples.pairs[before].position + samples.pairs[after].position) / 2;
}

// One line for all positions of a source that are excluded, each by the interval in whose zone it lies.
void add_scattered(const SourceSamples& samples, const Measurements& measured,
                   std::vector<ScaleFault>* faults) {
  std::map<size_t, double> found;  // by pair, displacement
  for (const IntervalMeasurement* m : measured)
    for (const size_t at : m->fit.scattered) {
      const TrackPair& pair = samples.pairs[at];
      if (pair.distance >= m->zone_begin && pair.distance < m->zone_end)
        found[at] = (pair.position - between_neighbours(samples, m->fit.scattered, at)).norm();
    }
  if (found.empty()) return;
  ScaleFault fault;
  fault.source = samples.source.text;
  fault.first_frame = samples.pairs[found.begin()->first].frame_index;
  fault.last_frame = samples.pairs[found.rbegin()->first].frame_index;
  fault.scattered = int(found.size());
  for (const auto& [at, displacement] : found)
    fault.displacement = std::max(fault.displacement, displacement);
  faults->push_back(fault);
}

ScaleFault without_measurement(const std::vector<MeasuredPath>& paths, size_t source) {
  ScaleFault fault;
  fault.source = paths.front().sources[source].source.text;
  fault.first_frame = paths.front().path->front().frame_index;
  fault.last_frame = paths.back().path->back().frame_index;
  return fault;
}

}  // namespace

std::vector<ScaleFault> scale_faults(const std::vector<MeasuredPath>& paths, const ScaleCourse& course) {
  std::vector<ScaleFault> faults;
  for (size_t s = 0; s < paths.front().sources.size(); ++s) {
    bool any = false;
    for (size_t p = 0; p < paths.size(); ++p) {
      const Measurements measured = of_source(course, p, s);
      any |= !measured.empty();
      add_wrong_lengths(paths[p], course.of_path[p], s, measured, &faults);
      add_displaced(paths[p].sources[s], measured, &faults);
      add_scattered(paths[p].sources[s], measured, &faults);
    }
    if (!any) faults.push_back(without_measurement(paths, s));
  }
  return faults;
}

}  // namespace edgevo
