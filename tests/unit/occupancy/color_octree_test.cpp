// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/occupancy/color_octree.h"

#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>

#include <memory>

#include "pole_and_wall.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

std::unique_ptr<octomap::ColorOcTree> written(const edgevo::Run& run) {
  const test::TempFolder folder;
  OccupancyParams params;
  params.resolution = "0.1", params.max_range = "15";
  write_color_octree(run, params.points, OctreeMap(run, params), folder / "color.ot");
  return std::unique_ptr<octomap::ColorOcTree>(
      dynamic_cast<octomap::ColorOcTree*>(octomap::AbstractOcTree::read(folder / "color.ot")));
}

TEST(ColorOctree, OccupiedVoxelsHaveTheGrayOfTheirEdges) {
  auto scene = test::pole_and_wall(2, 5);
  scene.run.keyframes[0].lines = {test::edge_line(scene.run.pinhole, scene.run.keyframes[0].T_world_cam,
                                                  {1.05, 0.05, 5.05}, {2.05, 0.05, 5.05}, 2)};
  const auto tree = written(scene.run);
  ASSERT_TRUE(tree);
  const auto gray_at = [&](const Eigen::Vector3d& p_world) {
    const Eigen::Vector3d p = T_map_world(scene.run) * p_world;
    const auto* node = tree->search(p.x(), p.y(), p.z());
    return node ? int(node->getColor().r) : -1;
  };
  EXPECT_EQ(gray_at({0.05, 0.05, 5.05}), 128) << "a point of the pole";
  EXPECT_EQ(gray_at({1.55, 0.05, 5.05}), 120) << "on the line, between its vertices: the mean of 40 and 200";
  EXPECT_EQ(gray_at({0.05, 0.05, 3.05}), -1) << "free space";
}

TEST(ColorOctree, AnEmptyMapGivesAnEmptyTree) {
  const auto tree = written(edgevo::Run());
  ASSERT_TRUE(tree);
  EXPECT_EQ(tree->size(), 0u);
}

}  // namespace
}  // namespace edgevo
