// SPDX-License-Identifier: BSD-3-Clause
#include "run.h"

#include <limits>

#include "arrays.h"
#include "classes.h"
#include "edgevo/core/error.h"
#include "edgevo/core/formatted.h"
#include "edgevo/core/output_file.h"
#include "edgevo/core/point_filter.h"
#include "edgevo/core/record_units.h"
#include "edgevo/results/run_text.h"
#include "record.h"

namespace edgevo::python {
namespace {

constexpr double kMaxSigma = 1e6;

const Run& run_of(const PyRun& r) { return r.contents->run; }

// An attribute that is made once.
template <class Make>
py::object made_once(PyRun& r, const char* name, Make make) {
  py::object& array = r.arrays[name];
  if (!array) array = make(run_of(r));
  return array;
}

py::array poses_array(const Run& run) {
  const size_t kFour = 4;
  py::array_t<double> array({run.frames.size(), kFour, kFour});
  double* out = array.mutable_data();
  using RowMajor = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  for (const FrameRecord& frame : run.frames) {
    Eigen::Map<RowMajor> T(out);
    if (frame.T_world_cam && frame.T_world_cam->is_finite())
      T = frame.T_world_cam->matrix();
    else
      T.setConstant(std::numeric_limits<double>::quiet_NaN());
    out += 16;
  }
  return read_only(std::move(array));
}

// The points of a keyframe whose depth is known to `max_sigma`, in the world.
void add_points(const Run& run, const KeyframeRecord& keyframe, double max_sigma,
                std::vector<Eigen::Vector3d>* points) {
  PointFilter filter;
  filter.max_relative_sigma = max_sigma;
  if (keyframe.is_doubtful) return;
  for (const EdgePoint& p : keyframe.points)
    if (filter.keeps(p)) points->push_back(keyframe.T_world_cam * point_in_camera(run.pinhole, p));
}

py::array points_of(PyRun& r, const Arguments& a) {
  const double max_sigma = a.number("sigma_max", PointFilter().max_relative_sigma);
  if (max_sigma <= 0 || max_sigma > kMaxSigma)
    throw bad_value(a.where("sigma_max"), "is " + describe(a.at("sigma_max")),
                    "give a share of the depth, above 0");
  std::vector<Eigen::Vector3d> points;
  for (const KeyframeRecord& k : run_of(r).keyframes) add_points(run_of(r), k, max_sigma, &points);
  return to_array(points);
}

py::list lines_of(PyRun& r, const Arguments&) {
  py::list lines;
  for (const KeyframeRecord& k : run_of(r).keyframes)
    for (const EdgeLine& line : k.lines) {
      std::vector<Eigen::Vector3d> vertices;
      for (const EdgeVertex& v : line.vertices)
        vertices.push_back(k.T_world_cam * point_in_camera(run_of(r).pinhole, v));
      lines.append(to_array(vertices));
    }
  return lines;
}

// A keyframe of a run, which it keeps alive.
struct PyKeyframe {
  std::shared_ptr<const RunContents> contents;
  size_t index;
  const KeyframeRecord& get() const { return contents->run.keyframes[index]; }
};

py::tuple keyframes_of(const PyRun& r) {
  py::tuple keyframes(run_of(r).keyframes.size());
  for (size_t i = 0; i < keyframes.size(); ++i) keyframes[i] = PyKeyframe{r.contents, i};
  return keyframes;
}

py::object to_evo(PyRun& r, const Arguments&) {
  py::module_ trajectory;
  try {
    trajectory = py::module_::import("evo.core.trajectory");
  } catch (py::error_already_set& e) {
    if (!e.matches(PyExc_ImportError)) throw;
    throw py::import_error("Run.to_evo(): evo is not installed; pip install evo");
  }
  std::vector<Eigen::Vector3d> positions;
  std::vector<double> times;
  std::vector<Eigen::Vector4d> rotations;
  for (const FrameRecord& f : run_of(r).frames) {
    if (!f.T_world_cam || !f.T_world_cam->is_finite()) continue;
    const Eigen::Quaterniond& q = f.T_world_cam->rotation();
    positions.push_back(f.T_world_cam->translation()), times.push_back(f.time.seconds());
    rotations.emplace_back(q.w(), q.x(), q.y(), q.z());
  }
  Eigen::MatrixXd wxyz(rotations.size(), 4);
  for (size_t i = 0; i < rotations.size(); ++i) wxyz.row(Eigen::Index(i)) = rotations[i];
  // evo changes its arrays in place.
  const auto own = [](const py::array& array) { return array.attr("copy")(); };
  return trajectory.attr("PoseTrajectory3D")(
      py::arg("positions_xyz") = own(to_array(positions)),
      py::arg("orientations_quat_wxyz") = own(to_array(wxyz)),
      py::arg("timestamps") = own(column<double>(times, [](double t) { return t; })));
}

py::none save(PyRun& r, const Arguments& a) {
  const std::string folder = a.path("folder");
  const py::gil_scoped_release released;
  write_run(*r.contents, folder);
  return {};
}

int with_pose(const Run& run) {
  int count = 0;
  for (const FrameRecord& frame : run.frames) count += frame.T_world_cam.has_value();
  return count;
}

std::string run_in_words(const PyRun& r) {
  return formatted("Run(%zu frames, %d with a pose, %zu keyframes; unit: %s)", run_of(r).frames.size(),
                   with_pose(run_of(r)), run_of(r).keyframes.size(), unit_statement(run_of(r)).c_str());
}

void add_keyframe(py::module_& module) {
  py::class_<PyKeyframe> keyframe(module, "Keyframe", "A keyframe of a run.");
  keyframe.def_property_readonly(
      "index", [](const PyKeyframe& k) { return k.get().frame_index; }, "Index of its frame.");
  keyframe.def_property_readonly(
      "time", [](const PyKeyframe& k) { return k.get().time.seconds(); }, "Time of its frame, seconds.");
  keyframe.def_property_readonly(
      "segment", [](const PyKeyframe& k) { return k.get().segment; }, "Number of its segment.");
  keyframe.def_property_readonly(
      "T_world_cam", [](const PyKeyframe& k) { return to_array(std::make_optional(k.get().T_world_cam)); },
      "Final pose, 4 x 4.");
  keyframe.def_property_readonly(
      "is_doubtful", [](const PyKeyframe& k) { return k.get().is_doubtful; },
      "Whether it was made in doubt: its pose and points are not to be trusted.");
  keyframe.def_property_readonly(
      "points",
      [](const PyKeyframe& k) {
        std::vector<Eigen::Vector3d> points;
        add_points(k.contents->run, k.get(), PointFilter().max_relative_sigma, &points);
        return to_array(points);
      },
      "The edge points that it holds, N x 3, in the world; of a doubtful keyframe none.");
}

void add_arrays(py::class_<PyRun>& run) {
  run.def_property_readonly(
      "times",
      [](PyRun& r) {
        return made_once(r, "times", [](const Run& run) {
          return column<double>(run.frames, [](const FrameRecord& f) { return f.time.seconds(); });
        });
      },
      "Times of all frames, (N,), seconds.");
  run.def_property_readonly(
      "times_ns",
      [](PyRun& r) {
        return made_once(r, "times_ns", [](const Run& run) {
          return column<int64_t>(run.frames, [](const FrameRecord& f) { return nanoseconds(f.time); });
        });
      },
      "The same in nanoseconds, int64: exact.");
  run.def_property_readonly(
      "poses", [](PyRun& r) { return made_once(r, "poses", poses_array); },
      "Final poses T_world_cam, (N, 4, 4): p_world = T p_cam; NaN for frames without one.");
  run.def_property_readonly(
      "states",
      [](PyRun& r) {
        return made_once(r, "states", [](const Run& run) {
          return column<uint8_t>(run.frames, [](const FrameRecord& f) { return int(f.state); });
        });
      },
      "States, (N,), uint8: compare with State.TRACKING and the others.");
  run.def_property_readonly(
      "segments",
      [](PyRun& r) {
        return made_once(r, "segments", [](const Run& run) {
          return column<int32_t>(run.frames, [](const FrameRecord& f) { return f.segment; });
        });
      },
      "Numbers of the connected parts of the trajectory, (N,), int32; -1: none.");
}

}  // namespace

const PyRun& run_argument(const Arguments& arguments, const char* argument) {
  if (!py::isinstance<PyRun>(arguments.at(argument))) arguments.refuse(argument, "a Run");
  return py::cast<const PyRun&>(arguments.at(argument));
}

void add_run(py::module_& module) {
  add_keyframe(module);
  py::class_<PyRun> run(
      module, "Run",
      "A finished run. World: axes of the first camera (x right, y down, z forward), origin\n"
      "at its first pose. All arrays are read-only.");
  add_arrays(run);
  run.def_property_readonly("keyframes", keyframes_of, "The keyframes, a tuple in the order of time.");
  run.def_property_readonly(
      "unit", [](const PyRun& r) { return unit_statement(run_of(r)); }, "Unit of all lengths, in words.");
  run.def_property_readonly(
      "is_metric", [](const PyRun& r) { return run_of(r).is_metric(); }, "Whether lengths are metres.");
  run.def_property_readonly(
      "scale_problem", [](const PyRun& r) { return run_of(r).scale.problem; },
      "Why lengths are not metres although a scale was wanted; else empty.");
  run.def_property_readonly(
      "is_in_map", [](const PyRun& r) { return is_in_kept_map(run_of(r)); },
      "Whether the run was found in the `map` that it was given: its frame and unit are those of that.");
  run.def_property_readonly(
      "T_map_world", [](const PyRun& r) { return to_array(std::make_optional(T_map_world(run_of(r)))); },
      "From the world to the axes of Map, 4 x 4: x forward, z up.");
  define(run, "Run.points(sigma_max=0.15)", points_of,
         "Edge points, N x 3, in the world.\n\nsigma_max: largest standard deviation of the depth, as a "
         "share of it.");
  define(run, "Run.lines()", lines_of,
         "3D edges: a list of M x 3 arrays, vertices along each edge, in the world.");
  define(run, "Run.save(folder)", save,
         "Writes the files of `edgevo run`: trajectories, maps, run.mcap, report.html, summary.yaml and "
         "others.");
  define(
      run, "Run.to_tum(path)",
      [](PyRun& r, const Arguments& a) {
        write_file(a.path("path"), trajectory_tum(run_of(r), PoseKind::kFinal));
      },
      "Writes the final poses as `t tx ty tz qx qy qz qw`, the bytes of trajectory_tum.txt.");
  define(run, "Run.to_evo()", to_evo, "The final poses as an evo.core.trajectory.PoseTrajectory3D.");
  run.def("__len__", [](const PyRun& r) { return run_of(r).frames.size(); });
  run.def("__repr__", run_in_words);
  define_function(
      module, "load_run(folder)",
      [](const Arguments& a) {
        const std::string folder = a.path("folder");
        const py::gil_scoped_release released;
        return PyRun{std::make_shared<const RunContents>(read_run(folder))};
      },
      "Reads the folder that Run.save() or `edgevo run` wrote. Lengths of points are in single precision.");
}

}  // namespace edgevo::python
