// Walls without texture between straight edges: what is filled, and what is not.
#include <gtest/gtest.h>
#include <octomap/ColorOcTree.h>
#include <octomap/OcTree.h>

#include <functional>
#include <memory>

#include "edgevo/occupancy/color_octree.h"
#include "edgevo/occupancy/edge_ply.h"
#include "edgevo/occupancy/edge_ply_reader.h"
#include "edgevo/occupancy/octree_map.h"
#include "pole_and_wall.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

constexpr double kHalf = 1;  // of the frame, which is a square
// Of the frame, in front of the first camera; in the middle of a voxel.
const Eigen::Vector3d kMiddle(0.05, 0.05, 5.05);

// Six cameras side by side, all of which see a square frame of four lines.
edgevo::Run framed_wall(double ahead = kMiddle.z()) {
  edgevo::Run run;
  run.pinhole = test::test_pinhole();
  for (int k = 0; k < 6; ++k) {
    KeyframeRecord keyframe;
    keyframe.frame_index = k;
    keyframe.T_world_cam = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.1 * k, 0, 0));
    run.keyframes.push_back(keyframe);
  }
  const auto corner = [ahead](double x, double y) {
    return Eigen::Vector3d(kMiddle.x() + kHalf * x, kMiddle.y() + kHalf * y, ahead);
  };
  const Eigen::Vector3d corners[] = {corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
  for (int i = 0; i < 4; ++i) {
    EdgeLine line = test::edge_line(run.pinhole, SE3(), corners[i], corners[(i + 1) % 4], 5);
    line.keyframes = 6;
    run.keyframes[0].lines.push_back(line);
  }
  return run;
}

OccupancyParams fill_params() {
  OccupancyParams params;
  params.resolution = "0.1", params.max_range = "30";
  params.fill = true;
  return params;
}

const octomap::OcTreeNode* node_at(const octomap::OcTree& tree, const Eigen::Vector3d& p_world) {
  const Eigen::Vector3d p = T_zup_world() * p_world;
  return tree.search(p.x(), p.y(), p.z());
}

bool is_filled(const edgevo::Run& run, const Eigen::Vector3d& p_world) {
  const OctreeMap map(run, fill_params());
  return node_at(map.filled(), p_world) != nullptr;
}

// Four points beside each other, `ahead` of the last camera; their rays pass the plane of the frame at
// `at_frame`.
void see_points(const Eigen::Vector3d& at_frame, double ahead, edgevo::Run* run) {
  KeyframeRecord& keyframe = run->keyframes.back();
  const Eigen::Vector3d eye = keyframe.T_world_cam.translation();
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d through = at_frame + Eigen::Vector3d(0, 0.01 * i, 0);
    const Eigen::Vector3d p = eye + (through - eye) * ahead / (through - eye).z();
    keyframe.points.push_back(test::edge_point(run->pinhole, keyframe.T_world_cam, p, 0.005, 5));
  }
}

TEST(WallFill, AFrameOfFourEdgesIsFilled) {
  const edgevo::Run run = framed_wall();
  const OctreeMap map(run, fill_params());
  for (double x = -0.9; x < 0.95; x += 0.1)
    for (double y = -0.9; y < 0.95; y += 0.1) {
      const Eigen::Vector3d p = kMiddle + Eigen::Vector3d(x, y, 0);
      const octomap::OcTreeNode* node = node_at(map.tree(), p);
      ASSERT_TRUE(node) << x << ' ' << y;
      EXPECT_NEAR(node->getOccupancy(), 0.6, 1e-5) << x << ' ' << y;
      EXPECT_TRUE(node_at(map.filled(), p)) << x << ' ' << y;
    }
  EXPECT_FALSE(node_at(map.tree(), kMiddle + Eigen::Vector3d(1.3, 0, 0))) << "beside the frame";
  EXPECT_FALSE(node_at(map.tree(), kMiddle + Eigen::Vector3d(0, 0, 0.3))) << "behind the wall";
  EXPECT_EQ(map.stats().filled_voxels, int64_t(map.filled().getNumLeafNodes()));
  EXPECT_LT(map.stats().filled_voxels, map.stats().occupied_voxels) << "the edges are not counted as filled";
}

TEST(WallFill, IsOffUnlessAskedFor) {
  OccupancyParams params = fill_params();
  params.fill = OccupancyParams().fill;
  const OctreeMap map(framed_wall(), params);
  EXPECT_EQ(map.stats().filled_voxels, 0);
  EXPECT_FALSE(node_at(map.tree(), kMiddle));
}

// A frame that is in pieces, as edges mostly are.
TEST(WallFill, BrokenLinesAreJoined) {
  edgevo::Run run = framed_wall();
  std::vector<EdgeLine> pieces;
  for (const EdgeLine& line : run.keyframes[0].lines)
    for (size_t i = 1; i < line.vertices.size(); ++i) {
      pieces.push_back(line);
      pieces.back().vertices = {line.vertices[i - 1], line.vertices[i]};
    }
  run.keyframes[0].lines = pieces;
  EXPECT_TRUE(is_filled(run, kMiddle));
}

TEST(WallFill, AFrameThatIsSeenThroughIsNoWall) {
  edgevo::Run run = framed_wall();
  see_points(kMiddle + Eigen::Vector3d(0.5, 0.5, 0), 12, &run);
  EXPECT_FALSE(is_filled(run, kMiddle)) << "a point behind, through a corner of the opening";
  run = framed_wall();
  see_points(kMiddle + Eigen::Vector3d(1.5, 0, 0), 12, &run);
  EXPECT_TRUE(is_filled(run, kMiddle)) << "a point behind, seen past the frame";
  run = framed_wall();
  see_points(kMiddle, kMiddle.z(), &run);
  EXPECT_TRUE(is_filled(run, kMiddle + Eigen::Vector3d(0.5, 0.5, 0))) << "a mark on the wall";
  EXPECT_EQ(OctreeMap(run, fill_params()).stats().patches_opened, 0);
}

// Of its lines each is seen by another keyframe only, or all by one.
TEST(WallFill, LinesThatFewSawTogetherFrameNothing) {
  edgevo::Run run = framed_wall();
  for (EdgeLine& line : run.keyframes[0].lines) line.keyframes = 2;
  EXPECT_FALSE(is_filled(run, kMiddle));
  for (EdgeLine& line : run.keyframes[0].lines) line.keyframes = 3;
  EXPECT_TRUE(is_filled(run, kMiddle));
}

TEST(WallFill, TwoPostsAloneAreNoWall) {
  edgevo::Run run = framed_wall();
  std::vector<EdgeLine>& lines = run.keyframes[0].lines;
  lines = {lines[1], lines[3]};  // the upright ones
  EXPECT_FALSE(is_filled(run, kMiddle));
}

TEST(WallFill, OutlinesAndBentLinesFrameNothing) {
  edgevo::Run run = framed_wall();
  for (EdgeLine& line : run.keyframes[0].lines) line.is_outline = true;
  EXPECT_FALSE(is_filled(run, kMiddle));
  run = framed_wall();
  for (EdgeLine& line : run.keyframes[0].lines) line.is_straight = false;
  EXPECT_FALSE(is_filled(run, kMiddle));
}

TEST(WallFill, TheDrivenWayIsOpen) {
  edgevo::Run run = framed_wall();
  KeyframeRecord beyond;  // drove through the frame
  beyond.T_world_cam = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.5, 0, 8));
  run.keyframes.push_back(beyond);
  EXPECT_FALSE(is_filled(run, kMiddle));
  run.keyframes.back().segment = 1;
  EXPECT_TRUE(is_filled(run, kMiddle)) << "where another segment lies is not known";
}

// The wall lies at the back of its voxels: rays may cross those and still end before it.
TEST(WallFill, NeverOverFreeVoxels) {
  constexpr double kWall = 5.09, kRayStops = 0.173;  // before its point: the diagonal of a voxel
  edgevo::Run run = framed_wall(kWall);
  const Eigen::Vector3d on_wall = kMiddle + Eigen::Vector3d(0.5, 0.2, 0);
  see_points(on_wall, kWall + kRayStops + 0.03, &run);
  OccupancyParams params = fill_params();
  params.carve_stop_sigmas = 0;
  const OctreeMap with(run, params);
  params.fill = false;
  const OctreeMap without(run, params);
  ASSERT_TRUE(node_at(with.filled(), kMiddle)) << "nothing was filled, so nothing is shown";
  ASSERT_TRUE(node_at(without.tree(), on_wall)) << "the ray did not reach the wall";
  octomap::OcTree before(without.tree());
  before.expand();
  for (auto leaf = before.begin_leafs(), end = before.end_leafs(); leaf != end; ++leaf) {
    EXPECT_FALSE(with.filled().search(leaf.getKey()));
    EXPECT_EQ(with.tree().search(leaf.getKey())->getLogOdds(), leaf->getLogOdds());
  }
}

TEST(WallFill, AFinishedRunIsFilledAlike) {
  edgevo::Run run = framed_wall();
  see_points(kMiddle, kMiddle.z(), &run);
  const test::TempFolder folder;
  const OccupancyParams params = fill_params();
  write_edge_ply(run, params.points, folder / "edges.ply");
  const OctreeMap again(read_edge_ply(folder / "edges.ply"), params);
  EXPECT_GT(again.stats().filled_voxels, 100);
  EXPECT_EQ(again.stats().filled_voxels, OctreeMap(run, params).stats().filled_voxels);
}

TEST(WallFill, FilledVoxelsAreOrange) {
  const edgevo::Run run = framed_wall();
  const OccupancyParams params = fill_params();
  const test::TempFolder folder;
  write_color_octree(run, params.points, OctreeMap(run, params), folder / "color.ot");
  std::unique_ptr<octomap::AbstractOcTree> read(octomap::AbstractOcTree::read(folder / "color.ot"));
  auto* tree = dynamic_cast<octomap::ColorOcTree*>(read.get());
  ASSERT_TRUE(tree);
  const Eigen::Vector3d wall = T_zup_world() * kMiddle,
                        edge = T_zup_world() * Eigen::Vector3d(kMiddle + Eigen::Vector3d(kHalf, 0, 0));
  ASSERT_TRUE(tree->search(wall.x(), wall.y(), wall.z()));
  EXPECT_EQ(tree->search(wall.x(), wall.y(), wall.z())->getColor(),
            octomap::ColorOcTreeNode::Color(255, 140, 0));
  ASSERT_TRUE(tree->search(edge.x(), edge.y(), edge.z()));
  EXPECT_EQ(tree->search(edge.x(), edge.y(), edge.z())->getColor().r, 120);
}

}  // namespace
}  // namespace edgevo
