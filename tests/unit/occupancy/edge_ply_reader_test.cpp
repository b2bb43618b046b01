// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/occupancy/edge_ply_reader.h"
#include "edgevo/core/depth_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "edgevo/core/output_file.h"
#include "edgevo/occupancy/edge_ply.h"
#include "edgevo/occupancy/octree_map.h"
#include "pole_and_wall.h"
#include "support/temp_folder.h"
#include "support/text.h"

namespace edgevo {
namespace {

using test::content;
using ::testing::HasSubstr;

edgevo::Run made_run() {
  edgevo::Run run = test::pole_and_wall(6, 5).run;
  run.scale_source = "camera_height=1.65";
  run.scale.factor = 2.1, run.scale.sigma = 0.012;
  Eigen::Matrix3d R;
  R << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  run.T_vehicle_cam = SE3(R, {0.3, 0.1, 1.2});
  run.keyframes.back().segment = 1;
  run.keyframes[2].lines = {
      test::edge_line(run.pinhole, run.keyframes[2].T_world_cam, {0, 0, 6}, {0.4, 0, 6}, 5),
      test::edge_line(run.pinhole, run.keyframes[2].T_world_cam, {0, 1, 6}, {0, 1, 7}, 3)};
  run.keyframes[2].lines[1].is_outline = true;
  run.keyframes[2].lines[1].views = 7, run.keyframes[2].lines[1].source = DepthSource::kPlane;
  run.keyframes[3].lines = {
      test::edge_line(run.pinhole, run.keyframes[3].T_world_cam, {0, 0, 5}, {0.4, 0, 6}, 4)};
  return run;
}

TEST(EdgePlyReader, RestoresTheRun) {
  const edgevo::Run run = made_run();
  const test::TempFolder folder;
  const int written = write_edge_ply(run, PointFilter(), folder / "edges.ply");
  const edgevo::Run read = read_edge_ply(folder / "edges.ply");
  EXPECT_EQ(unit_statement(read), unit_statement(run));
  ASSERT_TRUE(read.T_vehicle_cam);
  EXPECT_LT((read.T_vehicle_cam->matrix() - run.T_vehicle_cam->matrix()).norm(), 1e-7);
  ASSERT_EQ(read.keyframes.size(), run.keyframes.size());
  int points = 0;
  for (size_t k = 0; k < run.keyframes.size(); ++k) {
    EXPECT_LT((read.keyframes[k].T_world_cam.matrix() - run.keyframes[k].T_world_cam.matrix()).norm(), 1e-7);
    EXPECT_EQ(read.keyframes[k].segment, run.keyframes[k].segment);
    ASSERT_EQ(read.keyframes[k].points.size(), run.keyframes[k].points.size());
    for (size_t i = 0; i < run.keyframes[k].points.size(); ++i, ++points) {
      const EdgePoint &a = run.keyframes[k].points[i], &b = read.keyframes[k].points[i];
      EXPECT_LT((point_in_camera(run.pinhole, a) - point_in_camera(read.pinhole, b)).norm(), 1e-4);
      EXPECT_NEAR(b.idepth_sigma / b.idepth, a.idepth_sigma / a.idepth, 1e-5);
      EXPECT_EQ(b.observations, a.observations);
    }
  }
  EXPECT_EQ(points, written);
}

TEST(EdgePlyReader, RestoresTheLines) {
  const edgevo::Run run = made_run();
  const test::TempFolder folder;
  write_edge_ply(run, PointFilter(), folder / "edges.ply");
  const edgevo::Run read = read_edge_ply(folder / "edges.ply");
  for (size_t k = 0; k < run.keyframes.size(); ++k) {
    ASSERT_EQ(read.keyframes[k].lines.size(), run.keyframes[k].lines.size()) << k;
    for (size_t l = 0; l < run.keyframes[k].lines.size(); ++l) {
      const EdgeLine &a = run.keyframes[k].lines[l], &b = read.keyframes[k].lines[l];
      EXPECT_EQ(b.keyframes, a.keyframes);
      EXPECT_EQ(b.views, a.views);
      EXPECT_EQ(b.source, a.source);
      EXPECT_EQ(b.is_straight, a.is_straight);
      EXPECT_EQ(b.is_outline, a.is_outline);
      ASSERT_EQ(b.vertices.size(), a.vertices.size());
      for (size_t i = 0; i < a.vertices.size(); ++i) {
        EXPECT_LT((point_in_camera(run.pinhole, a.vertices[i]) - point_in_camera(read.pinhole, b.vertices[i]))
                      .norm(),
                  1e-4);
        EXPECT_EQ(b.vertices[i].gray_dark, 40);
        EXPECT_EQ(b.vertices[i].gray_bright, 200);
      }
    }
  }
}

TEST(EdgePlyReader, GivesTheSameMap) {
  const edgevo::Run run = made_run();
  const test::TempFolder folder;
  write_edge_ply(run, PointFilter(), folder / "edges.ply");
  OccupancyParams params;
  params.resolution = "0.1", params.max_range = "15";
  const OctreeMap before(run, params), after(read_edge_ply(folder / "edges.ply"), params);
  EXPECT_NEAR(double(after.stats().occupied_voxels), double(before.stats().occupied_voxels),
              0.005 * double(before.stats().occupied_voxels));
  EXPECT_NEAR(double(after.stats().free_voxels), double(before.stats().free_voxels),
              0.005 * double(before.stats().free_voxels));
}

TEST(EdgePlyReader, RefusesDamagedFiles) {
  const test::TempFolder folder;
  write_edge_ply(made_run(), PointFilter(), folder / "edges.ply");
  const std::string whole = content(folder / "edges.ply");
  const auto complaint = [&](const std::string& bytes) -> std::string {
    write_file(folder / "broken.ply", bytes);
    try {
      read_edge_ply(folder / "broken.ply");
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string bytes = whole;
    return bytes.replace(bytes.find(from), from.size(), to);
  };
  EXPECT_THAT(complaint(""), HasSubstr("is not a PLY file of edgevo"));
  EXPECT_THAT(complaint(whole.substr(0, 300)), HasSubstr("does not end"));
  EXPECT_THAT(complaint(whole.substr(0, whole.size() - 1)), HasSubstr("truncated"));
  EXPECT_THAT(complaint(with("comment scale ", "comment skale ")), HasSubstr("neither scale nor keyframes"));
  EXPECT_THAT(complaint(with("comment keyframe 0", "comment keyframe x")), HasSubstr("not readable"));
  EXPECT_THAT(complaint(with("comment keyframe 0", "comment keyfrane 0")), HasSubstr("keyframe"));
  EXPECT_THAT(complaint(with("element vertex ", "element vertex x")), HasSubstr("number of points"));
}

}  // namespace
}  // namespace edgevo
