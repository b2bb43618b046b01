// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/numpy.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "arguments.h"
#include "classes.h"
#include "edgevo/core/error.h"
#include "edgevo/core/formatted.h"
#include "edgevo/evaluation/evaluate.h"
#include "run.h"
#include "source.h"

namespace edgevo::python {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

Trajectory trajectory_at(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) return read_trajectory(path);
  SourceOptions options;
  options.path = path;
  options.any_camera = true;
  PySource source;
  source.options = options;
  source.source = open_source(options);
  return true_trajectory(source);
}

SE3 pose_of(const double* row_major, const std::string& where) {
  using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  constexpr double kTolerance = 1e-4;
  const RowMajor T = Eigen::Map<const RowMajor>(row_major);
  const Eigen::Matrix3d R = T.topLeftCorner<3, 3>();
  if (!(R.transpose() * R).isIdentity(kTolerance) || R.determinant() < 0)
    throw bad_value(where, "holds a matrix that is no rigid motion", "give (N, 4, 4) poses T_world_cam");
  return {R, T.topRightCorner<3, 1>()};
}

// Rows with NaN are frames without a pose.
Trajectory trajectory_of_arrays(const Arguments& a) {
  using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
  const auto pair = py::reinterpret_borrow<py::tuple>(a.at("truth"));
  const auto times = Numbers::ensure(pair[0]);
  const auto poses = Numbers::ensure(pair[1]);
  PyErr_Clear();
  if (!times || !poses || times.ndim() != 1 || poses.ndim() != 3 || poses.shape(0) != times.shape(0) ||
      poses.shape(1) != 4 || poses.shape(2) != 4)
    throw py::type_error(a.where("truth") + " is (" + describe(pair[0]) + "; " + describe(pair[1]) +
                         "); times (N,) and poses (N, 4, 4) are wanted");
  Trajectory trajectory;
  trajectory.path = "arrays";
  for (py::ssize_t i = 0; i < times.shape(0); ++i) {
    const double* T = poses.data(i, 0, 0);
    if (!std::isfinite(times.at(i)) || !std::isfinite(T[0])) continue;
    trajectory.poses.push_back({Timestamp::from_seconds(times.at(i)), pose_of(T, a.where("truth"))});
    const size_t n = trajectory.poses.size();
    if (n > 1 && !(trajectory.poses[n - 2].time < trajectory.poses[n - 1].time))
      throw bad_value(a.where("truth"), "holds times that do not increase", "sort it by time");
  }
  return trajectory;
}

TrajectoryEvaluation evaluate_run(const Arguments& a) {
  const std::shared_ptr<const RunContents> contents = run_argument(a, "run").contents;
  const py::handle truth = a.at("truth");
  const bool is_pair = py::isinstance<py::tuple>(truth) && py::len(truth) == 2;
  Trajectory of_arrays;
  PySource* source = nullptr;
  std::string path;
  if (is_pair)
    of_arrays = trajectory_of_arrays(a);
  else if (py::isinstance<PySource>(truth))
    source = py::cast<PySource*>(truth);
  else if (py::isinstance<py::str>(truth) || py::hasattr(truth, "__fspath__"))
    path = a.path("truth");
  else
    a.refuse("truth", "a path, a Source or (times, poses)");
  const py::gil_scoped_release released;
  EvaluationOptions options;
  options.frames_total = int(contents->run.frames.size());
  const Trajectory true_poses = is_pair ? of_arrays : source ? true_trajectory(*source) : trajectory_at(path);
  return evaluate(trajectory_of(contents->run), true_poses, options);
}

std::string evaluation_in_words(const TrajectoryEvaluation& e) {
  return formatted("Evaluation(ate=%.4g m, %d poses)", e.ate_sim3.rmse, e.matched);
}

}  // namespace

void add_evaluation(py::module_& module) {
  using E = TrajectoryEvaluation;
  py::class_<E> evaluation(module, "Evaluation", "Errors of a run against the truth.");
  evaluation.def_property_readonly(
      "ate", [](const E& e) { return e.ate_sim3.rmse; },
      "Absolute trajectory error, RMSE, metres, after a Sim(3) fit.");
  evaluation.def_property_readonly(
      "ate_se3", [](const E& e) { return e.ate_se3.rmse; }, "The same after an SE(3) fit.");
  evaluation.def_property_readonly(
      "scale", [](const E& e) { return e.ate_sim3.scale; }, "Metres per unit of the run, of the Sim(3) fit.");
  evaluation.def_property_readonly(
      "drift_percent", [](const E& e) { return e.drift ? e.drift->mean_cm_per_m : kUnknown; },
      "Mean translational drift, percent of the distance; NaN: the path is too short.");
  evaluation.def_readonly("matched", &E::matched, "Number of poses that were compared.");
  evaluation.def_property_readonly(
      "completion_percent", [](const E& e) { return e.coverage.completion_percent; },
      "Share of the frames with a pose, percent.");
  define(
      evaluation, "Evaluation.table()", [](E& e, const Arguments&) { return to_table(e); },
      "All figures as text.");
  define(
      evaluation, "Evaluation.json()", [](E& e, const Arguments&) { return to_json(e); },
      "All figures as JSON text.");
  evaluation.def("__repr__", evaluation_in_words);
  define_function(module, "evaluate(run, truth)", evaluate_run,
                  "Compares the final poses of a Run with the truth.\n\n"
                  "truth: path of a trajectory (TUM or KITTI) or of a data set, a Source that knows it, or\n"
                  "(times, poses): (N,) seconds and (N, 4, 4). The GIL is released meanwhile.");
}

}  // namespace edgevo::python
