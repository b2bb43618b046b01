// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/evaluation/alignment_hints.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "edgevo/core/error.h"
#include "edgevo/evaluation/absolute_error.h"
#include "time_steps.h"

namespace edgevo {
namespace {

constexpr double kBetter = 10;     // an error this many times smaller is a hint
constexpr size_t kMaxPoses = 300;  // compared; enough for the shape of a path
constexpr size_t kMinPoses = 10;   // fewer fit too many things
// An error below this share of the size of the path needs no explanation.
constexpr double kSmallError = 1e-3;

using Matches = std::vector<MatchedPose>;

Trajectory thinned(const Trajectory& all) {
  Trajectory some{all.path, all.format, {}};
  const size_t step = all.poses.size() / kMaxPoses + 1;
  for (size_t i = 0; i < all.poses.size(); i += step) some.poses.push_back(all.poses[i]);
  return some;
}

Timestamp later(Timestamp t, double seconds) {
  return {t.ticks + std::llround(seconds * double(Timestamp::kTicksPerSecond))};
}

Matches match(const Trajectory& estimate, const GroundTruth& truth, double offset_s = 0) {
  Matches matches;
  for (const StampedPose& pose : estimate.poses)
    if (const auto T_gt = truth.at(later(pose.time, offset_s)))
      matches.push_back({pose.time, 0, pose.T_world_cam, *T_gt});
  return matches;
}

// ---- positions ----

// ATE after a Sim(3) fit; infinite if there is none, or fewer than `fewest` matches.
double ate(const Matches& matches, size_t fewest = kMinPoses) {
  if (matches.size() < fewest || coincide(estimate_points(matches))) return HUGE_VAL;
  const auto error = ate_sim3(matches);
  return error ? error->rmse : HUGE_VAL;
}

template <class Change>
Matches changed(Matches matches, const Change& change) {
  for (MatchedPose& m : matches) change(&m);
  return matches;
}

struct Offset {
  double seconds = 0, error = HUGE_VAL;
};

// The best offset of `count` steps to each side of `around`.
Offset best_offset(const Trajectory& estimate, const GroundTruth& truth, double around, double step,
                   int count, size_t fewest) {
  Offset best;
  for (int k = -count; k <= count; ++k) {
    const double seconds = around + k * step;
    const double error = ate(match(estimate, truth, seconds), fewest);
    if (error < best.error) best = {seconds, error};
  }
  return best;
}

// Within ten seconds of `around`: in steps of half a pose, then ever finer.
Offset search_offset(const Trajectory& estimate, const GroundTruth& truth, double around, double pose_step_s,
                     size_t fewest) {
  constexpr double kReach = 10;
  constexpr int kMaxSteps = 400;
  double step = std::max(0.5 * pose_step_s, kReach / kMaxSteps);
  Offset best = best_offset(estimate, truth, around, step, int(kReach / step), fewest);
  while (step > 1e-3 && best.error < HUGE_VAL) {
    step /= 4;
    best = best_offset(estimate, truth, best.seconds, step, 4, fewest);
  }
  return best;
}

double step_of(const Trajectory& t) {
  return double(median_step_ticks(times_of(t))) / double(Timestamp::kTicksPerSecond);
}

std::string number(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string better(double before, double after) {
  return "ATE " + number("%.4g", after) + " m instead of " + number("%.4g", before) + " m";
}

// A truth of which hardly a pose lies in the time of the trajectory shows it a straight way between two of
// them: its times are probably in a smaller unit.
bool hint_at_time_unit(const Trajectory& estimate, const Trajectory& truth, std::vector<std::string>* hints) {
  constexpr int kMaxTruePoses = 3;
  constexpr double kTooFar = 100;  // steps of the trajectory between two true poses
  if (estimate.poses.size() < kMinPoses || truth.poses.size() < 2) return false;
  const auto within = [&](const StampedPose& p) {
    return estimate.poses.front().time <= p.time && p.time <= estimate.poses.back().time;
  };
  const double apart_s = step_of(truth);
  if (std::count_if(truth.poses.begin(), truth.poses.end(), within) > kMaxTruePoses ||
      apart_s < kTooFar * step_of(estimate))
    return false;
  hints->push_back("hardly a pose of the ground truth lies within the trajectory's time, since they are " +
                   number("%.4g", apart_s) +
                   " s apart: are its times in milliseconds? They must be in seconds");
  return true;
}

void hint_at_offset(const Trajectory& estimate, const GroundTruth& truth, double step_s,
                    const Matches& matches, double before, double given_s, std::vector<std::string>* hints) {
  const Offset best = search_offset(estimate, truth, 0, step_s, std::max(kMinPoses, matches.size() * 8 / 10));
  if (best.error * kBetter < before)
    hints->push_back("the clocks may differ: --t-offset " + number("%.3f", given_s + best.seconds) +
                     " gives " + better(before, best.error));
}

void hint_at_inverse(const Matches& matches, double before, std::vector<std::string>* hints) {
  const double of_estimate = ate(changed(matches, [](MatchedPose* m) { m->T_est = m->T_est.inverse(); }));
  const double of_truth = ate(changed(matches, [](MatchedPose* m) { m->T_gt = m->T_gt.inverse(); }));
  if (of_estimate * kBetter < before && of_estimate <= of_truth)
    hints->push_back("the poses of the trajectory may be from the world to the camera: --inverse gives " +
                     better(before, of_estimate));
  else if (of_truth * kBetter < before)
    hints->push_back("the poses of the ground truth may be from the world to the camera: --truth-inverse " +
                     std::string("gives ") + better(before, of_truth));
}

// A unit is named only if it explains the scale within the error: a monocular trajectory has an arbitrary
// one.
void hint_at_units(const Matches& matches, double sim3, std::vector<std::string>* hints) {
  constexpr double kAlike = 1.2;
  const auto as_is = ate_se3(matches);
  if (!as_is) return;
  for (const auto& [factor, unit] : {std::pair(0.001, "millimetres"), {0.01, "centimetres"}}) {
    for (const bool of_estimate : {true, false}) {
      const double f = of_estimate ? factor : 1 / factor;
      const auto error = ate_se3(changed(matches, [f = f](MatchedPose* m) {
        m->T_est = SE3(m->T_est.rotation(), f * m->T_est.translation());
      }));
      if (!error || error->rmse * kBetter > as_is->rmse || error->rmse > kAlike * sim3) continue;
      hints->push_back(std::string("the positions of the ") + (of_estimate ? "trajectory" : "ground truth") +
                       " may be in " + unit + ": ATE and drift are " +
                       (of_estimate ? "right, since they are aligned in scale; the SE(3) figure is not"
                                    : "then in " + std::string(unit) + ", too"));
    }
  }
}

// ---- motions in the axes of the poses, which drift compares ----

using Motions = Points;  // translations as columns

SE3 w_first(const SE3& T) {
  const Eigen::Quaterniond q = T.rotation();  // x y z hold w x y, w holds z
  return {Eigen::Quaterniond(q.x(), q.y(), q.z(), q.w()), T.translation()};
}

// Over intervals of a tenth of the poses.
template <class PoseOf>
Motions motions(const Matches& matches, const PoseOf& pose_of) {
  const size_t step = std::max<size_t>(1, matches.size() / 10);
  Motions all(3, Eigen::Index(matches.size() - step));
  for (size_t i = 0; i + step < matches.size(); ++i)
    all.col(Eigen::Index(i)) = (pose_of(matches[i]).inverse() * pose_of(matches[i + step])).translation();
  return all;
}

// RMS difference after one scale, relative to the motions.
double difference(const Motions& estimate, const Motions& truth) {
  const double est = estimate.norm(), gt = truth.norm();
  return est > 0 && gt > 0 ? (gt / est * estimate - truth).norm() / gt : HUGE_VAL;
}

// The constant rotation that turns `from` into `to` best.
Eigen::Matrix3d turn_between(const Motions& from, const Motions& to) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(to * from.transpose(),
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d sign = Eigen::Matrix3d::Identity();
  sign(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  return svd.matrixU() * sign * svd.matrixV().transpose();
}

void hint_at_rotations(const Matches& matches, std::vector<std::string>* hints) {
  constexpr double kSmallDrift = 0.05;
  const Motions e = motions(matches, [](const MatchedPose& m) { return m.T_est; });
  const Motions g = motions(matches, [](const MatchedPose& m) { return m.T_gt; });
  const double before = difference(e, g);
  if (before < kSmallDrift) return;
  const double e_first =
      difference(motions(matches, [](const MatchedPose& m) { return w_first(m.T_est); }), g);
  const double g_first =
      difference(e, motions(matches, [](const MatchedPose& m) { return w_first(m.T_gt); }));
  const double turned = difference(turn_between(e, g) * e, g);
  const auto says = [&](double error) {
    return number("%.3g", 100 * error) + " instead of " + number("%.3g", 100 * before) + " cm/m";
  };
  // The order of the quaternions first: in a plane it looks like other axes.
  if (e_first * kBetter < before && e_first < g_first)
    hints->push_back(
        "the quaternions of the trajectory may have w first: --quaternion wxyz gives errors of " +
        says(e_first));
  else if (g_first * kBetter < before)
    hints->push_back(
        "the quaternions of the ground truth may have w first: --truth-quaternion wxyz gives errors of " +
        says(g_first));
  else if (turned * kBetter < before)
    hints->push_back(
        "the poses may have other axes than the ground truth (such as z up against z forward): " +
        says(turned) +
        " after a constant turn; drift, t_rel and r_rel compare the axes, so convert one of them");
}

}  // namespace

void reread(const TrajectoryReading& reading, Trajectory* trajectory) {
  const bool is_kitti = trajectory->format == TrajectoryFormat::kKitti;
  if (is_kitti && reading.w_first)
    throw InputError(trajectory->path, "is a KITTI file, which has no quaternions", "omit the option");
  if (is_kitti && reading.t_offset_s != 0)
    throw InputError(trajectory->path, "is a KITTI file, which has no times", "omit --t-offset");
  for (StampedPose& pose : trajectory->poses) {
    pose.time = later(pose.time, reading.t_offset_s);
    if (reading.w_first) pose.T_world_cam = w_first(pose.T_world_cam);
    if (reading.inverse) pose.T_world_cam = pose.T_world_cam.inverse();
  }
}

std::vector<std::string> alignment_hints(const Trajectory& all, const Trajectory& ground_truth,
                                         double given_offset_s) {
  std::vector<std::string> hints;
  if (all.format != ground_truth.format) return hints;  // without common times
  if (all.format == TrajectoryFormat::kTum && hint_at_time_unit(all, ground_truth, &hints)) return hints;
  const Trajectory estimate = thinned(all);
  const GroundTruth truth(ground_truth);
  const Matches matches = match(estimate, truth);
  if (matches.size() < kMinPoses) return hints;
  const double before = ate(matches), size = spread(truth_points(matches));
  if (before < HUGE_VAL && before > kSmallError * size) {
    if (all.format == TrajectoryFormat::kTum)
      hint_at_offset(estimate, truth, step_of(all), matches, before, given_offset_s, &hints);
    hint_at_inverse(matches, before, &hints);
  }
  if (hints.empty() && before < 0.1 * size) hint_at_units(matches, before, &hints);
  if (hints.empty()) hint_at_rotations(matches, &hints);
  return hints;
}

std::optional<double> clock_offset(const Trajectory& all, const Trajectory& ground_truth) {
  constexpr double kFits = 0.02;  // of the size of the path: by chance it would be a large part of it
  if (all.format != TrajectoryFormat::kTum || ground_truth.format != TrajectoryFormat::kTum)
    return std::nullopt;
  const Trajectory estimate = thinned(all);
  if (estimate.poses.size() < kMinPoses) return std::nullopt;
  const GroundTruth truth(ground_truth);
  Offset best;
  for (const double around : {seconds_between(all.poses.front().time, ground_truth.poses.front().time),
                              seconds_between(all.poses.back().time, ground_truth.poses.back().time)}) {
    const Offset found = search_offset(estimate, truth, around, step_of(all), estimate.poses.size() / 2);
    if (found.error < best.error) best = found;
  }
  constexpr double kSmallest = 1e-3;  // a smaller offset explains no missing match
  if (std::abs(best.seconds) < kSmallest) return std::nullopt;
  const double size = spread(truth_points(match(estimate, truth, best.seconds)));
  return best.error < kFits * size ? std::make_optional(best.seconds) : std::nullopt;
}

}  // namespace edgevo
