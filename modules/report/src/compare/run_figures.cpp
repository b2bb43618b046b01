// SPDX-License-Identifier: BSD-3-Clause
#include "run_figures.h"

#include <limits>
#include <tuple>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/evaluation/absolute_error.h"

namespace edgevo {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Top view in the frame of the camera at the first pose (z forward, x right).
GroundPath seen_from(const SE3& T_world_first, const Points& positions) {
  GroundPath path;
  const SE3 T_first_world = T_world_first.inverse();
  for (Eigen::Index i = 0; i < positions.cols(); ++i) {
    const Eigen::Vector3d p = T_first_world * Eigen::Vector3d(positions.col(i));
    path.emplace_back(p.z(), -p.x());
  }
  return path;
}

Points positions_of(const Trajectory& trajectory) {
  Points points(3, Eigen::Index(trajectory.poses.size()));
  for (size_t i = 0; i < trajectory.poses.size(); ++i)
    points.col(Eigen::Index(i)) = trajectory.poses[i].T_world_cam.translation();
  return points;
}

Points aligned(const Trajectory& estimate, const Trajectory& truth) {
  const TimeMatches a = match_by_time(estimate, truth, find_input_frames(estimate, truth, {}));
  const std::optional<Sim3> T = fit_sim3(estimate_points(a.matches), truth_points(a.matches));
  Points points = positions_of(estimate);
  for (Eigen::Index i = 0; T && i < points.cols(); ++i)
    points.col(i) = T->rigid * Eigen::Vector3d(T->scale * points.col(i));
  return points;
}

void add_truth(const ComparedRun& run, GroundTruths* truths, RunFigures* f) {
  f->truth = truths->read(run.ground_truth);
  f->evaluation = evaluate(run.trajectory, *f->truth, {});
  const SE3& first = f->truth->poses.front().T_world_cam;
  f->path = seen_from(first, aligned(run.trajectory, *f->truth));
  f->truth_path = seen_from(first, positions_of(*f->truth));
}

}  // namespace

double RunFigures::ate_percent() const {
  const bool moves = evaluation && evaluation->drift && evaluation->drift->path_m > 0;
  return moves ? 100 * evaluation->ate_sim3.rmse / evaluation->drift->path_m : kNone;
}

double RunFigures::completion_percent() const {
  return run->frames > 0 ? 100.0 * double(run->trajectory.poses.size()) / run->frames : 0;
}

double RunFigures::scale_drift() const {
  if (!evaluation || evaluation->scale_curve.size() < 2) return kNone;
  return evaluation->scale_curve.back().relative_scale / evaluation->scale_curve.front().relative_scale;
}

std::shared_ptr<const Trajectory> GroundTruths::read(const std::string& path) {
  std::shared_ptr<const Trajectory>& known = by_path_[path];
  if (known) return known;
  const std::string text = read_file(path, "the run's ground truth has moved");
  std::shared_ptr<const Trajectory>& same = by_text_[text];
  if (!same) same = std::make_shared<const Trajectory>(parse_trajectory(text, path));
  return known = same;
}

RunFigures figures_of(const ComparedRun& run, GroundTruths* truths) {
  RunFigures f;
  f.run = &run;
  if (!run.problem.empty()) return f;
  if (run.trajectory.poses.empty()) {
    f.note = "no frame has a pose";
    return f;
  }
  f.path = seen_from(run.trajectory.poses.front().T_world_cam, positions_of(run.trajectory));
  if (run.ground_truth.empty()) return f;
  try {
    add_truth(run, truths, &f);
  } catch (const InputError& e) {
    f.note = e.what();
  }
  return f;
}

bool is_worse(const RunFigures& a, const RunFigures& b) {
  const auto rank = [](const RunFigures& f) {
    const double error = f.ate_percent();
    const int kind = !f.run->problem.empty() ? 0 : !f.note.empty() ? 1 : f.evaluation ? 2 : 3;
    return std::make_tuple(kind, error == error ? -error : 0.0, f.completion_percent());
  };
  return rank(a) < rank(b);
}

}  // namespace edgevo
