// SPDX-License-Identifier: BSD-3-Clause
#include <octomap/OcTree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "arguments.h"
#include "arrays.h"
#include "classes.h"
#include "edgevo/core/error.h"
#include "edgevo/core/formatted.h"
#include "edgevo/occupancy/map_size.h"
#include "edgevo/occupancy/octree_map.h"
#include "edgevo/results/run_maps.h"
#include "run.h"
#include "run_parameters.h"

namespace edgevo::python {
namespace {

using octomap::OcTree;
using octomap::point3d;

// The maps of a run for planners: octree and grid, in the axes of the map files.
struct PyMap {
  PyMap(const Run& run, const MapParams& params, std::string note_on_size)
      : note(std::move(note_on_size)),
        octree(run, params.occupancy),
        grid(make_grid(run, octree, camera_height_of(run, params.grid), params.grid)),
        unit(unit_statement(run)) {}

  const OcTree& tree() const { return octree.tree(); }

  std::string note;
  OctreeMap octree;
  OccupancyGrid grid;
  std::string unit;
};

std::unique_ptr<PyMap> make_map(const Arguments& a) {
  const std::shared_ptr<const RunContents> contents = run_argument(a, "run").contents;
  MapParams params = a.has("params") ? run_params(a, "params").map : contents->map;
  const py::gil_scoped_release released;
  std::string note = coarsen_to_fit(contents->run, free_memory(), &params.occupancy);
  check_map_size(contents->run, params.occupancy, free_memory(), "Map()");
  return std::make_unique<PyMap>(contents->run, params, std::move(note));
}

point3d to_octomap(const Eigen::Vector3d& p) { return {float(p.x()), float(p.y()), float(p.z())}; }

// What is known of a place; nothing outside the octree or where no ray has passed.
std::optional<bool> is_occupied(const OcTree& tree, const Eigen::Vector3d& p) {
  octomap::OcTreeKey key;
  if (!tree.coordToKeyChecked(to_octomap(p), key)) return std::nullopt;
  const octomap::OcTreeNode* const node = tree.search(key);
  if (!node) return std::nullopt;
  return tree.isNodeOccupied(node);
}

// Corners of the octree's content.
struct Box {
  Eigen::Vector3d min, max;
};

Box extent(const OcTree& tree) {
  Box box;
  tree.getMetricMin(box.min.x(), box.min.y(), box.min.z());
  tree.getMetricMax(box.max.x(), box.max.y(), box.max.z());
  return box;
}

double distance_to_voxel(const Eigen::Vector3d& p, const OcTree::leaf_bbx_iterator& voxel) {
  const Eigen::Vector3d centre(voxel.getX(), voxel.getY(), voxel.getZ());
  const Eigen::Vector3d outside = (p - centre).cwiseAbs().array() - voxel.getSize() / 2;
  return outside.cwiseMax(0).norm();
}

// Distance to the nearest occupied voxel that reaches into the cube of half side `reach` about p.
double nearest_within(const OcTree& tree, const Box& all, const Eigen::Vector3d& p, double reach) {
  // What lies outside the content would be reported on stderr by octomap.
  const double inset = tree.getResolution() / 4;
  const Eigen::Vector3d low = (p.array() - reach).matrix().cwiseMax((all.min.array() + inset).matrix());
  const Eigen::Vector3d high = (p.array() + reach).matrix().cwiseMin((all.max.array() - inset).matrix());
  double nearest = std::numeric_limits<double>::infinity();
  if ((low.array() > high.array()).any()) return nearest;
  for (auto it = tree.begin_leafs_bbx(to_octomap(low), to_octomap(high)), end = tree.end_leafs_bbx();
       it != end; ++it)
    if (tree.isNodeOccupied(*it)) nearest = std::min(nearest, distance_to_voxel(p, it));
  return nearest;
}

// Infinite in an empty map. The cube grows until it holds the nearest voxel for sure.
double distance(const OcTree& tree, const Box& all, const Eigen::Vector3d& p) {
  constexpr int kFirstVoxels = 4;
  const double farthest = (p - all.min).cwiseAbs().cwiseMax((p - all.max).cwiseAbs()).maxCoeff();
  for (double reach = kFirstVoxels * tree.getResolution();; reach *= 2) {
    const double found = nearest_within(tree, all, p, reach);
    if (found <= reach || reach > farthest) return found;
  }
}

// One value for a point, an array for N of them.
template <class T, class Value>
py::object for_points(const Arguments& a, Value value) {
  const std::vector<Eigen::Vector3d> points = to_points(a.at("xyz"), a.where("xyz"));
  const bool is_one = py::array::ensure(a.at("xyz")).attr("ndim").cast<int>() == 1;
  std::vector<T> values(points.size());
  {
    const py::gil_scoped_release released;
    std::transform(points.begin(), points.end(), values.begin(), value);
  }
  // std::vector<bool> is none of bytes.
  using Item = std::conditional_t<std::is_same_v<T, char>, bool, T>;
  if (is_one) return py::cast(Item(values[0]));
  return column<Item>(values, [](T v) { return v; });
}

py::object occupied(PyMap& m, const Arguments& a) {
  return for_points<char>(
      a, [&](const Eigen::Vector3d& p) { return char(is_occupied(m.tree(), p).value_or(false)); });
}

py::object known_free(PyMap& m, const Arguments& a) {
  return for_points<char>(
      a, [&](const Eigen::Vector3d& p) { return char(!is_occupied(m.tree(), p).value_or(true)); });
}

py::object distances(PyMap& m, const Arguments& a) {
  const Box all = extent(m.tree());
  return for_points<double>(a, [&](const Eigen::Vector3d& p) {
    return m.tree().size() == 0 ? std::numeric_limits<double>::infinity() : distance(m.tree(), all, p);
  });
}

// As ROS has it.
int8_t grid_value(GridCell cell) {
  constexpr int8_t kUnknown = -1, kFree = 0, kOccupied = 100;
  return cell == GridCell::kOccupied ? kOccupied : cell == GridCell::kFree ? kFree : kUnknown;
}

py::array grid_of(const PyMap& m) {
  py::array_t<int8_t> array({m.grid.height, m.grid.width});
  std::transform(m.grid.cells.begin(), m.grid.cells.end(), array.mutable_data(), grid_value);
  return read_only(std::move(array));
}

std::string map_in_words(const PyMap& m) {
  return formatted("Map(%lld voxels of %g occupied, grid of %d x %d)",
                   (long long)m.octree.stats().occupied_voxels, m.tree().getResolution(), m.grid.height,
                   m.grid.width);
}

}  // namespace

void add_map(py::module_& module) {
  py::class_<PyMap> map(
      module, "Map",
      "The map of a Run for planners, an OctoMap and a grid: x forward, y left, z up (Run.T_map_world), in\n"
      "the unit of the run.\n\n"
      "params: dict of names and values of the groups occupancy and grid; by default those of the run.");
  define_init(map, "Map(run, params={})", make_map);
  define(map, "Map.occupied(xyz)", occupied,
         "Whether an edge is known to be there: bool of a point (3,), array (N,) of points (N, 3).");
  define(
      map, "Map.free(xyz)", known_free,
      "Whether the place was seen to be free; where neither is true, it is unknown. Shapes as occupied().");
  define(map, "Map.distance(xyz)", distances,
         "Distance to the nearest occupied voxel, 0 within one, infinity if there is none. Shapes as\n"
         "occupied(), float64.");
  map.def_property_readonly(
      "grid", grid_of,
      "The grid seen from above, int8 H x W: 100 occupied, 0 free, -1 unknown. Row 0 has\n"
      "the smallest y, column 0 the smallest x.");
  map.def_property_readonly(
      "origin", [](const PyMap& m) { return py::make_tuple(m.grid.origin_x, m.grid.origin_y); },
      "x and y of the lower corner of grid[0, 0].");
  map.def_property_readonly(
      "resolution", [](const PyMap& m) { return m.grid.resolution; }, "Side of a cell of the grid.");
  map.def_property_readonly(
      "voxel", [](const PyMap& m) { return m.tree().getResolution(); }, "Side of a voxel of the OctoMap.");
  map.def_readonly("unit", &PyMap::unit, "Unit of all lengths, in words.");
  map.def_readonly("note", &PyMap::note, "Why the voxels are coarser than usual; empty: they are not.");
  map.def("__repr__", map_in_words);
}

}  // namespace edgevo::python
