// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/occupancy/octree_map.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <fstream>
#include <memory>
#include <sstream>

#include "edgevo/core/error.h"
#include "pole_and_wall.h"
#include "support/temp_folder.h"
#include "support/text.h"

namespace edgevo {
namespace {

using test::content;
using test::pole_and_wall;
using ::testing::HasSubstr;

OccupancyParams fixed_size(const char* resolution = "0.1") {
  OccupancyParams params;
  params.resolution = resolution;
  params.max_range = "15";
  return params;
}

octomap::point3d in_map(const edgevo::Run& run, const Eigen::Vector3d& p_world) {
  const Eigen::Vector3d p = T_map_world(run) * p_world;
  return {float(p.x()), float(p.y()), float(p.z())};
}

enum class Voxel { kUnknown, kFree, kOccupied };

Voxel at(const octomap::OcTree& tree, const edgevo::Run& run, const Eigen::Vector3d& p_world) {
  const auto* node = tree.search(in_map(run, p_world));
  if (!node) return Voxel::kUnknown;
  return tree.isNodeOccupied(node) ? Voxel::kOccupied : Voxel::kFree;
}

double occupied_share(const octomap::OcTree& tree, const edgevo::Run& run,
                      const std::vector<Eigen::Vector3d>& points) {
  int n = 0;
  for (const auto& p : points) n += at(tree, run, p) == Voxel::kOccupied;
  return double(n) / double(points.size());
}

TEST(OctreeMap, PointsAreOccupiedRaysFreeAndTheRestUnknown) {
  const auto scene = pole_and_wall(1, 5);
  const OctreeMap map(scene.run, fixed_size());
  EXPECT_EQ(occupied_share(map.tree(), scene.run, scene.wall), 1.0);
  EXPECT_EQ(at(map.tree(), scene.run, {0, 0, 2}), Voxel::kFree);
  EXPECT_EQ(at(map.tree(), scene.run, {0, 0, 12}), Voxel::kUnknown) << "behind the wall";
  EXPECT_EQ(at(map.tree(), scene.run, {0, -5, 2}), Voxel::kUnknown) << "outside the view";
}

// In each of ten keyframes, rays to the wall cross every voxel of the pole; eight keyframes observed the
// pole.
TEST(OctreeMap, ThinEdgeSurvivesTheRaysOfManyKeyframes) {
  const auto scene = pole_and_wall(10, 8);
  const OctreeMap map(scene.run, fixed_size());
  EXPECT_GE(occupied_share(map.tree(), scene.run, scene.pole), 0.95);
  EXPECT_EQ(occupied_share(map.tree(), scene.run, scene.wall), 1.0);
}

// Conversely, an edge that does not exist (observed twice, then seen through) is erased.
TEST(OctreeMap, WrongPointsAreCarvedAway) {
  const auto scene = pole_and_wall(10, 2);
  const OctreeMap map(scene.run, fixed_size());
  EXPECT_EQ(occupied_share(map.tree(), scene.run, scene.pole), 0.0);
}

TEST(OctreeMap, UncertainPointsCarveNothing) {
  auto scene = pole_and_wall(1, 5);
  for (EdgePoint& p : scene.run.keyframes[0].points) p.idepth_sigma = 0.1f * p.idepth;
  const OctreeMap map(scene.run, fixed_size());
  EXPECT_EQ(map.stats().rays, 0);
  EXPECT_EQ(map.stats().free_voxels, 0);
  EXPECT_GT(map.stats().occupied_voxels, 500);
}

// The ray of an outlier behind the wall, with a small sigma, would free the inside of the wall. Four such
// points next to each other are accepted.
TEST(OctreeMap, LonePointsCarveNothing) {
  const auto free_behind_the_wall = [](int points) {
    auto scene = pole_and_wall(1, 5);
    for (int i = 0; i < points; ++i)
      scene.run.keyframes[0].points.push_back(
          test::edge_point(scene.run.pinhole, SE3(), {1.12 + 0.1 * i, 0.05, 14}, 0.001, 5));
    return at(OctreeMap(scene.run, fixed_size()).tree(), scene.run,
              {1.12 * 12.05 / 14, 0.05 * 12.05 / 14, 12.05}) == Voxel::kFree;
  };
  EXPECT_FALSE(free_behind_the_wall(1));
  EXPECT_FALSE(free_behind_the_wall(3));
  EXPECT_TRUE(free_behind_the_wall(4));
}

TEST(OctreeMap, RaysStopSomeSigmasBeforeThePoint) {
  edgevo::Run run;
  run.pinhole = test::test_pinhole();
  run.keyframes.resize(1);
  run.keyframes[0].points = {test::edge_point(run.pinhole, SE3(), {0.05, 0.05, 10}, 0.04, 5)};
  OccupancyParams params = fixed_size();  // three sigmas: 1.2
  params.carve_neighbours = 0;
  const OctreeMap map(run, params);
  EXPECT_EQ(at(map.tree(), run, {0.05 * 0.86, 0.05 * 0.86, 8.6}), Voxel::kFree);
  EXPECT_EQ(at(map.tree(), run, {0.05 * 0.9, 0.05 * 0.9, 9.0}), Voxel::kUnknown);
  EXPECT_EQ(at(map.tree(), run, {0.05, 0.05, 10}), Voxel::kOccupied);
}

// A bar given by its ends: all voxels between them are occupied, and no ray to the wall behind erases them.
TEST(OctreeMap, LinesAreDrawnVoxelByVoxel) {
  auto scene = pole_and_wall(6, 5);
  const Eigen::Vector3d a(-0.95, 0.05, 5.05), b(0.95, 0.05, 5.05);
  EdgeLine bar = test::edge_line(scene.run.pinhole, scene.run.keyframes[0].T_world_cam, a, b, 2);
  bar.keyframes = 6;
  scene.run.keyframes[0].lines = {bar};
  const OctreeMap map(scene.run, fixed_size());
  for (double x = -0.95; x < 1; x += 0.1)
    EXPECT_EQ(at(map.tree(), scene.run, {x, 0.05, 5.05}), Voxel::kOccupied) << x;
}

// Nearby, too: at 5 m, 2 % are a voxel.
TEST(OctreeMap, ALineOfUncertainDepthIsNotDrawn) {
  auto scene = pole_and_wall(6, 5);
  const Eigen::Vector3d a(-0.95, 0.05, 5.05), b(0.95, 0.05, 5.05);
  EdgeLine bar = test::edge_line(scene.run.pinhole, scene.run.keyframes[0].T_world_cam, a, b, 2);
  for (EdgeVertex& v : bar.vertices) v.idepth_sigma = 0.02f * v.idepth;
  scene.run.keyframes[0].lines = {bar};
  EXPECT_NE(at(OctreeMap(scene.run, fixed_size()).tree(), scene.run, {0.55, 0.05, 5.05}), Voxel::kOccupied);
}

// A bar seen by the first keyframe from 18 m, beyond the range of 15.
Voxel far_bar(double relative_sigma, double forward_later) {
  auto scene = pole_and_wall(2, 5);
  const Eigen::Vector3d a(-0.95, 0.05, 18.05), b(0.95, 0.05, 18.05);
  EdgeLine bar = test::edge_line(scene.run.pinhole, scene.run.keyframes[0].T_world_cam, a, b, 2);
  for (EdgeVertex& v : bar.vertices) v.idepth_sigma = float(relative_sigma) * v.idepth;
  scene.run.keyframes[0].lines = {bar};
  scene.run.keyframes[1].T_world_cam =
      SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, forward_later));
  return at(OctreeMap(scene.run, fixed_size()).tree(), scene.run, {0.05, 0.05, 18.05});
}

TEST(OctreeMap, PointsBeyondTheRangeCountIfTheCameraComesNearLater) {
  EXPECT_EQ(far_bar(0.0025, 5), Voxel::kOccupied);
  EXPECT_NE(far_bar(0.0025, 1), Voxel::kOccupied) << "the camera stayed out of range";
  EXPECT_NE(far_bar(0.01, 5), Voxel::kOccupied) << "depth not known to half a voxel";
}

TEST(OctreeMap, MetricVoxelsAreAtMostAFifthOfAMetre) {
  auto scene = pole_and_wall(2, 5);
  for (KeyframeRecord& k : scene.run.keyframes)  // five times as large: a median depth of 50
    for (EdgePoint& p : k.points) p.idepth *= 0.2f, p.idepth_sigma *= 0.2f;
  EXPECT_DOUBLE_EQ(OctreeMap(scene.run, OccupancyParams()).stats().resolution, 1);
  scene.run.scale_source = "odometry";
  EXPECT_DOUBLE_EQ(OctreeMap(scene.run, OccupancyParams()).stats().resolution, 0.2);
  OccupancyParams given;
  given.resolution = "0.5";
  EXPECT_DOUBLE_EQ(OctreeMap(scene.run, given).stats().resolution, 0.5);
}

TEST(OctreeMap, MetricVoxelsAreNoFinerThanAPixelAtTheMedianDepth) {
  auto scene = pole_and_wall(2, 5);
  scene.run.scale_source = "given";
  for (KeyframeRecord& k : scene.run.keyframes)  // a median depth of 100,000 metres
    for (EdgePoint& p : k.points) p.idepth *= 1e-4f, p.idepth_sigma *= 1e-4f;
  const double footprint = 1e5 / scene.run.pinhole.fx;
  EXPECT_NEAR(OctreeMap(scene.run, OccupancyParams()).stats().resolution, footprint, 0.01 * footprint);
}

TEST(OctreeMap, NothingIsMappedBeyondTheRange) {
  const auto scene = pole_and_wall(1, 5);
  OccupancyParams params = fixed_size();
  params.max_range = "7";
  const OctreeMap map(scene.run, params);
  EXPECT_EQ(occupied_share(map.tree(), scene.run, scene.wall), 0.0);
  EXPECT_EQ(map.stats().beyond_range, int(scene.wall.size()));
  EXPECT_EQ(at(map.tree(), scene.run, {0, 0, 6.5}), Voxel::kFree) << "rays carve up to the range";
  EXPECT_EQ(at(map.tree(), scene.run, {0, 0, 7.5}), Voxel::kUnknown);
}

// A second segment with a wrong scale has a wall behind that of the first.
TEST(OctreeMap, SegmentsDoNotEraseEachOther) {
  auto first = pole_and_wall(1, 3);
  auto second = pole_and_wall(12, 3);
  edgevo::Run run = first.run;
  for (KeyframeRecord keyframe : second.run.keyframes) {
    keyframe.segment = 1;
    keyframe.points.clear();
    for (const auto& p : second.wall)
      keyframe.points.push_back(test::edge_point(run.pinhole, keyframe.T_world_cam, 1.3 * p, 0.01, 4));
    run.keyframes.push_back(keyframe);
  }
  EXPECT_EQ(occupied_share(OctreeMap(run, fixed_size()).tree(), run, first.wall), 1.0);
  for (KeyframeRecord& keyframe : run.keyframes) keyframe.segment = 0;
  EXPECT_LT(occupied_share(OctreeMap(run, fixed_size()).tree(), run, first.wall), 0.9)
      << "within one segment those rays must count, or this test shows nothing";
}

TEST(OctreeMap, SizesFollowTheMedianDepth) {
  const auto scene = pole_and_wall(2, 5);
  const OctreeMap map(scene.run, OccupancyParams());
  EXPECT_NEAR(map.stats().median_depth, 10, 0.1);
  EXPECT_NEAR(map.stats().resolution, 0.2, 1e-12);
  EXPECT_NEAR(map.tree().getResolution(), 0.2, 1e-12);
  EXPECT_NEAR(map.stats().max_range, 20, 1e-9);
}

TEST(OctreeMap, BothFilesGiveTheSameMap) {
  const auto scene = pole_and_wall(3, 5);
  const OctreeMap map(scene.run, fixed_size());
  const test::TempFolder folder;
  const std::string prefix = folder / "edges";
  map.write_bt(prefix + ".bt");
  map.write_ot(prefix + ".ot");
  octomap::OcTree bt(prefix + ".bt");
  std::unique_ptr<octomap::AbstractOcTree> read(octomap::AbstractOcTree::read(prefix + ".ot"));
  const auto* ot = dynamic_cast<const octomap::OcTree*>(read.get());
  ASSERT_NE(ot, nullptr);
  EXPECT_EQ(ot->getNumLeafNodes(), map.tree().getNumLeafNodes());
  octomap::OcTree expanded(*ot);
  expanded.expand();
  EXPECT_EQ(int64_t(expanded.getNumLeafNodes()), map.stats().occupied_voxels + map.stats().free_voxels);
  for (const octomap::OcTree* tree : {&std::as_const(bt), ot}) {
    EXPECT_NEAR(tree->getResolution(), 0.1, 1e-12);
    EXPECT_EQ(occupied_share(*tree, scene.run, scene.wall), 1.0);
    EXPECT_EQ(occupied_share(*tree, scene.run, scene.pole), 1.0);
    EXPECT_EQ(at(*tree, scene.run, {0, 0, 2}), Voxel::kFree);
    EXPECT_EQ(at(*tree, scene.run, {0, 0, 12}), Voxel::kUnknown);
  }
}

TEST(OctreeMap, AnEmptyRunGivesValidEmptyFiles) {
  const OctreeMap map(edgevo::Run{}, OccupancyParams{});
  EXPECT_EQ(map.tree().size(), 0u);
  EXPECT_GT(map.stats().resolution, 0);
  const test::TempFolder folder;
  const std::string prefix = folder / "edges";
  map.write_bt(prefix + ".bt");
  map.write_ot(prefix + ".ot");
  octomap::OcTree bt(0.5);
  EXPECT_TRUE(bt.readBinary(prefix + ".bt"));
  EXPECT_EQ(bt.size(), 0u);
  std::unique_ptr<octomap::AbstractOcTree> ot(octomap::AbstractOcTree::read(prefix + ".ot"));
  ASSERT_NE(ot, nullptr);
  EXPECT_EQ(ot->size(), 0u);
}

TEST(OctreeMap, SameRunSameBytesAndNothingOnStderr) {
  const auto scene = pole_and_wall(5, 5);
  const test::TempFolder folder;
  const std::string path = folder / "edges.ot";
  const auto bytes = [&] {
    OctreeMap(scene.run, OccupancyParams()).write_ot(path);
    return content(path);
  };
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(bytes(), bytes());
  OctreeMap(scene.run, OccupancyParams()).write_bt(path);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(OctreeMap, HeadersStateTheUnit) {
  auto scene = pole_and_wall(1, 5);
  const test::TempFolder folder;
  const std::string path = folder / "edges.bt";
  OctreeMap(scene.run, OccupancyParams()).write_bt(path);
  EXPECT_THAT(content(path), HasSubstr("# unit: arbitrary"));
  scene.run.scale_source = "gps";
  OctreeMap(scene.run, OccupancyParams()).write_bt(path);
  EXPECT_THAT(content(path), HasSubstr("# unit: metre (scale from gps)"));
}

TEST(OctreeMap, AFullDiskIsReported) {
  const OctreeMap map(pole_and_wall(1, 5).run, fixed_size());
  try {
    map.write_bt("/dev/full");
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("No space left on device"));
  }
}

TEST(OctreeMap, PointsOutsideTheTreeAreCountedNotCarved) {
  edgevo::Run run;
  run.pinhole = test::test_pinhole();
  run.keyframes.resize(1);
  run.keyframes[0].T_world_cam = SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0, 0, 1e6));
  run.keyframes[0].points = {
      test::edge_point(run.pinhole, run.keyframes[0].T_world_cam, {0, 0, 1e6 + 5}, 0.01, 5)};
  const OctreeMap map(run, fixed_size());
  EXPECT_EQ(map.stats().out_of_bounds, 1);
  EXPECT_EQ(map.tree().size(), 0u);
}

TEST(OccupancyParams, ReportsInvalidLengths) {
  OccupancyParams params;
  for (const char* bad : {"", "0", "-1", "0.2m", "nan", "inf", "small"}) {
    params.resolution = bad;
    EXPECT_THROW(params.check(), InputError) << bad;
  }
  params.resolution = "0.25";
  params.check();
  EXPECT_EQ(params.given_resolution(), 0.25);
}

TEST(OccupancyParams, WrittenValuesReadBack) {
  OccupancyParams written;
  written.resolution = "0.3";
  written.points.min_observations = 7;
  const std::string text = write_params([&](ParamVisitor& v) { written.visit(v); });
  OccupancyParams read;
  read_params(text, "test", [&](ParamVisitor& v) { read.visit(v); });
  EXPECT_EQ(read.resolution, "0.3");
  EXPECT_EQ(read.max_range, "auto");
  EXPECT_EQ(read.points.min_observations, 7);
}

}  // namespace
}  // namespace edgevo
