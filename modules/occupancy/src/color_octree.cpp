// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/occupancy/color_octree.h"

#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <sstream>
#include <unordered_map>

#include "edgevo/core/output_file.h"
#include "octree_file.h"

namespace edgevo {
namespace {

octomap::point3d to_octomap(const Eigen::Vector3d& p) { return {float(p.x()), float(p.y()), float(p.z())}; }

// Mean gray of each voxel.
class VoxelGrays {
 public:
  explicit VoxelGrays(const octomap::OcTree& tree) : tree_(tree) {}

  struct Gray {
    long sum = 0, count = 0;
  };

  void add(const Eigen::Vector3d& p, int gray) {
    octomap::OcTreeKey key;
    if (tree_.coordToKeyChecked(to_octomap(p), key)) add(key, gray);
  }
  void add_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to, int gray) {
    octomap::OcTreeKey key;
    const octomap::point3d a = to_octomap(from), b = to_octomap(to);
    if (!tree_.coordToKeyChecked(a, key) || !tree_.coordToKeyChecked(b, key) ||
        !tree_.computeRayKeys(a, b, ray_))
      return;
    for (const octomap::OcTreeKey& between : ray_) add(between, gray);
  }

  octomap::ColorOcTree colored() const {
    octomap::ColorOcTree colored(tree_.getResolution());
    for (const auto& [key, gray] : grays_) {
      const octomap::OcTreeNode* node = tree_.search(key);
      if (!node || !tree_.isNodeOccupied(node)) continue;
      const auto mean = uint8_t(gray.sum / gray.count);
      colored.setNodeValue(key, node->getLogOdds(), /*lazy_eval=*/true)->setColor(mean, mean, mean);
    }
    if (colored.size() > 0) colored.updateInnerOccupancy();  // octomap 1.9 does not check for a root
    return colored;
  }

 private:
  void add(const octomap::OcTreeKey& key, int gray) {
    Gray& there = grays_[key];
    there.sum += gray, ++there.count;
  }

  const octomap::OcTree& tree_;
  octomap::KeyRay ray_;
  std::unordered_map<octomap::OcTreeKey, Gray, octomap::OcTreeKey::KeyHash> grays_;
};

void add_keyframe(const Run& run, const KeyframeRecord& k, const PointFilter& filter, VoxelGrays* grays) {
  const SE3 T_map_cam = T_map_world(run) * k.T_world_cam;
  for (const EdgePoint& p : k.points)
    if (filter.keeps(p)) grays->add(T_map_cam * point_in_camera(run.pinhole, p), p.gray);
  for (const EdgeLine& line : k.lines)
    for (size_t i = 0; i < line.vertices.size(); ++i) {
      const EdgeVertex& v = line.vertices[i];
      const int gray = (v.gray_dark + v.gray_bright) / 2;
      const Eigen::Vector3d p = T_map_cam * point_in_camera(run.pinhole, v);
      grays->add(p, gray);
      if (i > 0) grays->add_between(T_map_cam * point_in_camera(run.pinhole, line.vertices[i - 1]), p, gray);
    }
}

}  // namespace

void write_color_octree(const Run& run, const PointFilter& filter, const OctreeMap& map,
                        const std::string& path) {
  VoxelGrays grays(map.tree());
  for (const KeyframeRecord& k : run.keyframes)
    if (k.T_world_cam.is_finite()) add_keyframe(run, k, filter, &grays);
  const octomap::ColorOcTree colored = grays.colored();
  std::ostringstream nodes;
  colored.writeData(nodes);
  write_file(path, octree_header(kOtFirstLine, octree_comments(run), colored) + nodes.str());
}

}  // namespace edgevo
