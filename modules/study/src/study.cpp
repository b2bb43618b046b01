// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/study/study.h"
#include "edgevo/core/thread_clock.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <opencv2/core.hpp>
#include <utility>

#include "edgevo/core/angle.h"
#include "edgevo/core/error.h"
#include "edgevo/core/order_statistics.h"
#include "edgevo/core/run_parallel.h"
#include "edgevo/simulation/relight.h"
#include "experiments.h"

namespace edgevo {
namespace {

constexpr double kMaxDriftPercent = 100;  // drift of a failed solution: the whole motion

// Limits OpenCV to one thread during its lifetime: times are CPU times of one thread, and hosts are already
// spread over threads.
class OneOpenCvThread {
 public:
  OneOpenCvThread() : before_(cv::getNumThreads()) { cv::setNumThreads(1); }
  ~OneOpenCvThread() { cv::setNumThreads(before_); }
  OneOpenCvThread(const OneOpenCvThread&) = delete;
  OneOpenCvThread& operator=(const OneOpenCvThread&) = delete;

 private:
  int before_;
};

ImageView<float> depth_view(const ExactFrame& frame, const Pinhole& p) {
  return {frame.depth.data(), p.width, p.height, p.width};
}

// ---- which frames ----

// Hosts, spread evenly; each has max_distance frames before it (for the prediction) and after it.
std::vector<int> choose_hosts(const ExactFrames& frames, const StudyOptions& options) {
  const int end = options.end < 0 ? frames.size() : options.end;
  if (options.begin < 0 || end > frames.size() || options.begin >= end)
    throw InputError(frames.name(),
                     "frames " + std::to_string(options.begin) + ":" + std::to_string(end) + " are not in it",
                     "it has frames 0:" + std::to_string(frames.size()));
  const int first = options.begin + options.max_distance, last = end - 1 - options.max_distance;
  if (first > last)
    throw InputError(frames.name(),
                     "a distance of " + std::to_string(options.max_distance) +
                         " frames to both sides of a host needs " +
                         std::to_string(2 * options.max_distance + 1) + " frames, there are " +
                         std::to_string(end - options.begin),
                     "take more frames");
  std::vector<int> hosts;
  const int count = std::min(options.pairs, last - first + 1);
  for (int i = 0; i < count; ++i)
    hosts.push_back(count > 1 ? first + int(std::lround(double(last - first) * i / (count - 1))) : first);
  return hosts;
}

// Pixels of a frame, transferred to the next one by depth and pose, must agree with it.
void check_truth(const ExactFrames& frames, int index) {
  const Pinhole p = frames.camera().pinhole();
  const ExactFrame from = frames.load(index), to = frames.load(index + 1);
  const ViewPair views{p, depth_view(from, p), depth_view(to, p),
                       to.T_world_cam.inverse() * from.T_world_cam};
  constexpr int kStep = 7;  // pixels between those checked: enough to decide
  int in_view = 0, visible = 0;
  for (int v = kStep; v < p.height - kStep; v += kStep)
    for (int u = kStep; u < p.width - kStep; u += kStep) {
      const Correspondence c = find_correspondence(views, {double(u), double(v)});
      if (!(c.idepth > 0)) continue;
      in_view += c.in_view;
      visible += c.visible;
    }
  if (in_view == 0 || visible < in_view / 2)
    throw InputError(frames.name(),
                     "depth and poses of frames " + std::to_string(index) + " and " +
                         std::to_string(index + 1) + " do not belong together: " + std::to_string(visible) +
                         " of " + std::to_string(in_view) + " pixels agree",
                     "check that all parts are of one sequence and release");
}

// ---- one pair ----

void compare_pose(const SE3& T, const SE3& truth, StudySample* sample) {
  const double drift = 100 * (T.translation() - truth.translation()).norm() / truth.translation().norm();
  sample->drift_percent = std::isfinite(drift) ? std::min(drift, kMaxDriftPercent) : kMaxDriftPercent;
  const double cosine = T.translation().normalized().dot(truth.translation().normalized());
  sample->direction_deg = deg(std::acos(std::clamp(cosine, -1.0, 1.0)));
  sample->rotation_deg = deg((T.inverse() * truth).angle());
}

// Errors of the matches that also fix the position along the edge.
std::vector<MatchError> photometric_only(const std::vector<MatchError>& errors) {
  std::vector<MatchError> some;
  std::copy_if(errors.begin(), errors.end(), std::back_inserter(some),
               [](const MatchError& e) { return e.kind == MatchKind::kPhotometric; });
  return some;
}

StudySample front_end_alone(const TargetView& target) {
  StudySample sample;
  sample.track_ms = target.track_ms;
  sample.failed = target.is_lost;
  if (!sample.failed) compare_pose(target.track.T_cur_ref, target.T_target_host, &sample);
  return sample;
}

StudySample run_pair(const HostView& host, const TargetView& target, const PairMatcher& matcher,
                     std::vector<MatchError>* errors) {
  StudySample sample;
  sample.track_ms = target.track_ms;
  if (matcher.needs_front_end() && target.is_lost) return sample;
  const Pinhole& camera = target.pyramid->finest().pinhole;
  double start = thread_cpu_ms();
  const auto lap = [&] {
    const double now = thread_cpu_ms();
    return now - std::exchange(start, now);
  };
  std::vector<Match> matches = matcher.match(host, target);
  sample.match_ms = lap();
  *errors = match_errors(host, target, matches);
  for (const Match& m : matches)
    sample.matches += m.kind != MatchKind::kNone, sample.photometric += m.kind == MatchKind::kPhotometric;
  const ErrorSummary summary = summarise(photometric_only(*errors));
  sample.wrong_share = summary.wrong_share;
  sample.median_px = summary.median_px;
  lap();
  TwoViewSolution solution = solve_two_view(camera, host.points, matches, target.T_start);
  sample.solve_ms = lap();
  if (!solution.usable) return sample;
  matcher.update(host, target, solution, &matches);
  sample.match_ms += lap();
  const TwoViewSolution second = solve_two_view(camera, host.points, matches, solution.T_target_host);
  sample.solve_ms += lap();
  if (second.usable) solution = second;
  sample.failed = false;
  compare_pose(solution.T_target_host, target.T_target_host, &sample);
  return sample;
}

// ---- all ----

class Study {
 public:
  Study(const ExactFrames& frames, const StudyOptions& options, std::vector<int> hosts)
      : frames_(frames),
        options_(options),
        hosts_(std::move(hosts)),
        experiments_(make_experiments(options)),
        relight_(options.light, options.seed),
        errors_(experiments_.size() * 2 * hosts_.size()),
        flow_(hosts_.size()) {
    for (const char* light : kStudyLights)
      for (const Experiment& e : experiments_)
        cells_.push_back(
            {e.curve, light, e.method, e.setting, e.position, std::vector<StudySample>(hosts_.size()), {}});
  }

  void run_host(int h) {
    PyramidBuilder builder(frames_.camera(), EdgeParams());
    const Pinhole& pinhole = builder.pinhole();
    const ExactFrame frame = frames_.load(hosts_[size_t(h)]);
    Random random = Random::derive(options_.seed, uint64_t(frame.index));
    auto pyramid = builder.build(frame.image);
    auto points = sample_points(pyramid->finest().edges, depth_view(frame, pinhole), options_.points,
                                options_.noise, &random);
    const HostView host = make_host(std::move(pyramid), std::move(points));
    for (int distance = 1; distance <= options_.max_distance; ++distance) {
      const ExactFrame next = frames_.load(frame.index + distance);
      const SE3 T_step = frame.T_world_cam.inverse() * frames_.T_world_cam(frame.index - distance);
      const ViewPair views{pinhole, depth_view(frame, pinhole), depth_view(next, pinhole),
                           next.T_world_cam.inverse() * frame.T_world_cam};
      for (size_t light = 0; light < 2; ++light) {
        const GrayImage image =
            light == 0 ? next.image : relight_.apply(next.image, next.index, next.seconds);
        const TargetView target = make_target(host, builder.build(image), views, T_step);
        if (distance == 1) flow_[size_t(h)] = median_flow(host, target);
        run_experiments(host, target, distance, light, size_t(h));
      }
    }
  }

  StudyResult result() {
    for (size_t c = 0; c < cells_.size(); ++c)
      for (size_t h = 0; h < hosts_.size(); ++h) {
        const auto& errors = errors_[c * hosts_.size() + h];
        cells_[c].errors.insert(cells_[c].errors.end(), errors.begin(), errors.end());
      }
    StudyResult result{options_, frames_.name(), 0, std::move(cells_)};
    for (const double flow : flow_) result.median_flow_px_per_frame += flow / double(flow_.size());
    return result;
  }

 private:
  void run_experiments(const HostView& host, const TargetView& target, int distance, size_t light, size_t h) {
    for (size_t e = 0; e < experiments_.size(); ++e) {
      if (experiments_[e].distance != distance) continue;
      const size_t cell = light * experiments_.size() + e;
      std::vector<MatchError> errors;
      const PairMatcher* matcher = experiments_[e].matcher.get();
      cells_[cell].samples[h] = matcher ? run_pair(host, target, *matcher, &errors) : front_end_alone(target);
      if (experiments_[e].keeps_errors) errors_[cell * hosts_.size() + h] = std::move(errors);
    }
  }

  static double median_flow(const HostView& host, const TargetView& target) {
    std::vector<double> flow;
    for (size_t i = 0; i < host.points.size(); ++i)
      if (target.truth[i].visible) flow.push_back((target.truth[i].px - host.points[i].px).norm());
    return median(std::move(flow));
  }

  const ExactFrames& frames_;
  StudyOptions options_;
  std::vector<int> hosts_;
  std::vector<Experiment> experiments_;
  Relight relight_;
  std::vector<StudyCell> cells_;                 // light by light, in the order of experiments_
  std::vector<std::vector<MatchError>> errors_;  // of each cell and host
  std::vector<double> flow_;
};

}  // namespace

void check_study(const ExactFrames& frames, const StudyOptions& options) {
  const Relight known_kind(options.light, options.seed);
  if (options.distance > options.max_distance)
    throw InputError("distance " + std::to_string(options.distance),
                     "is more than the largest distance, " + std::to_string(options.max_distance),
                     "make one smaller or the other larger");
  choose_hosts(frames, options);
}

StudyResult run_study(const ExactFrames& frames, const StudyOptions& options,
                      const std::function<void(int)>& on_host_done) {
  check_study(frames, options);
  const std::vector<int> hosts = choose_hosts(frames, options);
  check_truth(frames, hosts.front());
  const OneOpenCvThread one_thread;
  Study study(frames, options, hosts);
  std::mutex mutex;
  int done = 0;
  run_parallel(0, int(hosts.size()), std::max(1, options.threads), [&](int h) {
    study.run_host(h);
    const std::lock_guard<std::mutex> lock(mutex);
    if (on_host_done) on_host_done(++done);
  });
  return study.result();
}

}  // namespace edgevo
