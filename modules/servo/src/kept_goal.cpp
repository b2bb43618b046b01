// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/servo/kept_goal.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <utility>

#include "edgevo/core/error.h"
#include "edgevo/core/formatted.h"
#include "edgevo/core/output_file.h"
#include "edgevo/kept_map/kept_map.h"
#include "edgevo/kept_map/map_file_writer.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

std::string goal_file(const std::string& folder) { return (fs::path(folder) / "goal.txt").string(); }
std::string map_file(const std::string& folder) { return (fs::path(folder) / kMapFile).string(); }

std::string text_of(const KeptGoal& goal) {
  const Eigen::Vector3d& t = goal.T_map_taught.translation();
  const Eigen::Quaterniond& q = goal.T_map_taught.rotation();
  return formatted("# metres_per_unit tx ty tz qx qy qz qw: the taught pose in map.db, in its unit\n") +
         formatted("%.17g %.17g %.17g %.17g %.17g %.17g %.17g %.17g\n", goal.metres_per_unit, t.x(), t.y(),
                   t.z(), q.x(), q.y(), q.z(), q.w());
}

}  // namespace

void write_kept_loop(const KeptLoop& loop, const std::string& folder) {
  const std::string what = "edgevo servo";
  MapFileWriter map(map_file(folder), {loop.run.pinhole, camera_text(Camera(loop.run.pinhole)), what});
  for (const StoredKeyframe& k : loop.keyframes) map.add(k);
  map.finish(loop.run);
  write_file(goal_file(folder), text_of(loop.goal));
}

KeptGoal read_kept_goal(const std::string& folder) {
  const std::string file = goal_file(folder);
  std::ifstream in(file);
  if (!in.is_open())
    throw InputError(file, "cannot be opened",
                     "give the folder of a run of `edgevo servo` that taught a pose");
  std::string header;
  double scale = 0, x = 0, y = 0, z = 0, qx = 0, qy = 0, qz = 0, qw = 0;
  std::getline(in, header);
  in >> scale >> x >> y >> z >> qx >> qy >> qz >> qw;
  const Eigen::Quaterniond q(qw, qx, qy, qz);
  if (!in || !(scale > 0) || !(q.norm() > 0.5))
    throw InputError(file, "holds no taught pose", "give the folder of a run of `edgevo servo`");
  return {SE3(q.normalized(), {x, y, z}), scale};
}

std::shared_ptr<const PlaceStore> read_kept_places(const std::string& folder, const Pinhole& pinhole) {
  return std::make_shared<const PlaceStore>(read_finished_map(folder, pinhole).store);
}

}  // namespace edgevo
