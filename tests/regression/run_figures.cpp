// SPDX-License-Identifier: BSD-3-Clause
#include "run_figures.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <numeric>
#include <opencv2/core.hpp>

#include "edgevo/alignment/pose_covariance.h"

namespace edgevo::test {
namespace {

double path_length(const Trajectory& truth, Timestamp begin, Timestamp end) {
  double length = 0;
  const StampedPose* last = nullptr;
  for (const StampedPose& pose : truth.poses) {
    if (pose.time < begin || end < pose.time) continue;
    if (last) length += (pose.T_world_cam.translation() - last->T_world_cam.translation()).norm();
    last = &pose;
  }
  return length;
}

double cpu_ms(const Run& run) {
  double sum = 0;
  for (const FrameRecord& frame : run.frames)
    for (const auto& stage : frame.stage_ms) sum += stage.second;
  return sum / double(run.frames.size());
}

// Pose of the ground truth at a time; nullopt where it has none.
std::optional<SE3> pose_at(const Trajectory& truth, Timestamp time) {
  for (const StampedPose& pose : truth.poses)
    if (std::abs(seconds_between(pose.time, time)) < 1e-3) return pose.T_world_cam;
  return std::nullopt;
}

}  // namespace

Consistency pose_consistency(const Run& run, const Trajectory& truth, double metres_per_unit) {
  constexpr double kLow = 0.831, kHigh = 12.833;  // 2.5 and 97.5 % of chi^2 with five degrees of freedom
  Consistency c;
  int inside = 0;
  for (const FrameRecord& frame : run.frames) {
    if (!frame.T_world_cam || frame.is_keyframe || frame.covariance.isZero()) continue;
    const KeyframeRecord& reference = run.keyframes[size_t(frame.reference_keyframe)];
    const auto T_world_cam = pose_at(truth, frame.time), T_world_ref = pose_at(truth, reference.time);
    if (!T_world_cam || !T_world_ref) continue;
    const SE3 estimate = frame.T_world_cam->inverse() * reference.T_world_cam;
    const SE3 metric(estimate.rotation(), metres_per_unit * estimate.translation());
    Vector6d unit = Vector6d::Ones();
    unit.head<3>().setConstant(metres_per_unit);
    const double square = normalised_error_square(metric, T_world_cam->inverse() * *T_world_ref,
                                                  unit.asDiagonal() * frame.covariance * unit.asDiagonal());
    c.mean_ratio += square / kNormalisedErrorFreedom;
    inside += square > kLow && square < kHigh;
    ++c.frames;
  }
  if (c.frames > 0) c.mean_ratio /= c.frames, c.inside = double(inside) / c.frames;
  return c;
}

Run run_source(ImageSource& source, const OdometryParams& params, uint64_t seed,
               const std::optional<Pinhole>& working_pinhole) {
  cv::setNumThreads(1);
  OdometryOptions options;
  options.seed = seed;
  options.working_pinhole = working_pinhole;
  Odometry odometry(source.camera(), params, options);
  for (std::optional<Frame> frame = source.next(); frame; frame = source.next()) odometry.process(*frame);
  return odometry.finish();
}

Run run_source(ImageSource& source, const std::vector<GyroSample>& gyro, uint64_t seed) {
  constexpr double kAfterS = 0.3;  // as far as clocks may differ, and a sample
  cv::setNumThreads(1);
  OdometryOptions options;
  options.seed = seed;
  Odometry odometry(source.camera(), {}, options);
  auto next = gyro.begin();
  while (const std::optional<Frame> frame = source.next()) {
    for (; next != gyro.end() && seconds_between(frame->time, next->time) < kAfterS; ++next)
      odometry.add_gyro(*next);
    odometry.process(*frame);
  }
  return odometry.finish();
}

RunAccuracy measure(Run run, const Trajectory& truth) {
  RunAccuracy figures;
  EvaluationOptions options;
  options.frames_total = int(run.frames.size());
  const Trajectory estimate = trajectory_of(run);
  figures.evaluation = evaluate(estimate, truth, options);
  figures.path_m = path_length(truth, estimate.poses.front().time, estimate.poses.back().time);
  figures.ate_percent = 100 * figures.evaluation.ate_sim3.rmse / figures.path_m;
  for (const ScalePoint& p : figures.evaluation.scale_curve)
    figures.scale_drift = std::max(figures.scale_drift, std::abs(std::log(p.relative_scale)));
  const auto posed = [](const FrameRecord& f) { return f.T_world_cam.has_value(); };
  const auto first = std::find_if(run.frames.begin(), run.frames.end(), posed);
  figures.first_posed = int(first - run.frames.begin());
  figures.completion = double(std::count_if(first, run.frames.end(), posed)) / double(run.frames.size());
  figures.mean_cpu_ms = cpu_ms(run);
  figures.consistency = pose_consistency(run, truth, figures.evaluation.ate_sim3.scale);
  figures.run = std::move(run);
  return figures;
}

std::vector<uint64_t> test_seeds() {
  const char* requested = std::getenv("EDGEVO_TEST_SEEDS");
  std::vector<uint64_t> seeds(requested ? size_t(std::max(1, std::atoi(requested))) : 1);
  std::iota(seeds.begin(), seeds.end(), 1);
  return seeds;
}

void for_each_seed(const std::shared_ptr<const Clip>& clip, const Trajectory& truth,
                   const std::function<void(const RunAccuracy&)>& check,
                   const std::optional<Pinhole>& working_pinhole) {
  for (const uint64_t seed : test_seeds()) {
    ClipSource source(clip);
    const RunAccuracy figures = measure(run_source(source, {}, seed, working_pinhole), truth);
    std::cout << "[ figures  ] seed " << seed << ": " << figures << std::endl;
    check(figures);
  }
}

Trajectory truth_of(const Scene& scene, int begin, int end) {
  Trajectory truth;
  truth.path = "scene " + scene.name;
  for (int i = begin; i < end; ++i)
    truth.poses.push_back({scene.times[size_t(i)], scene.T_scene_cam[size_t(i)]});
  return truth;
}

std::ostream& operator<<(std::ostream& out, const RunAccuracy& f) {
  return out << f.run.frames.size() << " frames, path " << f.path_m << " m: ATE "
             << f.evaluation.ate_sim3.rmse << " m (" << f.ate_percent
             << " % of the path), local scale off by " << 100 * f.scale_drift << " %, first pose at frame "
             << f.first_posed << ", completion " << f.completion << ", " << f.mean_cpu_ms
             << " CPU ms a frame; error over covariance " << f.consistency.mean_ratio << ", "
             << 100 * f.consistency.inside << " % of " << f.consistency.frames
             << " frames within its 95 % bounds";
}

}  // namespace edgevo::test
