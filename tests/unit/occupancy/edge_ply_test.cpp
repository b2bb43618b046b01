// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/occupancy/edge_ply.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "pole_and_wall.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;

// Memory layout of a vertex on a little-endian machine. Packed: copy a member before binding a reference to
// it.
#pragma pack(push, 1)
struct Vertex {
  float xyz[3];
  uint8_t rgb[3];
  float idepth, idepth_sigma;
  int32_t keyframe, observations, line;
  uint8_t gray_dark, gray_bright, line_kind, views;
};
#pragma pack(pop)

struct Ply {
  std::string header;
  std::vector<Vertex> vertices;
  std::vector<std::pair<int32_t, int32_t>> edges;
};

int count_in(const std::string& header, const std::string& element) {
  const size_t at = header.find("element " + element + " ");
  return at == std::string::npos ? 0 : std::stoi(header.substr(at + element.size() + 9));
}

Ply read_ply(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::stringstream text;
  text << in.rdbuf();
  const std::string bytes = text.str();
  const std::string end = "end_header\n";
  const size_t body = bytes.find(end) + end.size();
  Ply ply{bytes.substr(0, body), {}, {}};
  ply.vertices.resize(size_t(count_in(ply.header, "vertex")));
  ply.edges.resize(size_t(count_in(ply.header, "edge")));
  if (!ply.vertices.empty())
    std::memcpy(ply.vertices.data(), bytes.data() + body, ply.vertices.size() * sizeof(Vertex));
  const size_t edges = body + ply.vertices.size() * sizeof(Vertex);
  if (!ply.edges.empty()) std::memcpy(ply.edges.data(), bytes.data() + edges, ply.edges.size() * 8);
  EXPECT_EQ(edges + ply.edges.size() * 8, bytes.size()) << "bytes left over";
  return ply;
}

edgevo::Run two_keyframes() {
  edgevo::Run run;
  run.pinhole = test::test_pinhole();
  run.keyframes.resize(2);
  run.keyframes[1].T_world_cam =
      SE3(Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY())), {1, 0.5, -2});
  for (int k = 0; k < 2; ++k) {
    EdgePoint p = test::edge_point(run.pinhole, run.keyframes[k].T_world_cam, {0.5, -0.25, 8}, 0.02, 3 + k);
    p.gray = uint8_t(100 + 100 * k);
    run.keyframes[k].points = {p};
  }
  run.keyframes[0].points.push_back(test::edge_point(run.pinhole, SE3(), {0, 0, 5}, 0.02, 1));  // seen once
  return run;
}

TEST(EdgePly, HoldsThePointsZUpWithTheirProperties) {
  const test::TempFolder folder;
  const std::string path = folder / "edges.ply";
  EXPECT_EQ(write_edge_ply(two_keyframes(), PointFilter(), path), 2);
  const Ply ply = read_ply(path);
  ASSERT_EQ(ply.vertices.size(), 2u);
  EXPECT_THAT(ply.header, HasSubstr("format binary_little_endian 1.0\n"));
  EXPECT_THAT(ply.header, HasSubstr("element vertex 2\n"));
  for (int k = 0; k < 2; ++k) {
    const Vertex& v = ply.vertices[size_t(k)];
    EXPECT_NEAR(v.xyz[0], 8, 1e-4);     // forward
    EXPECT_NEAR(v.xyz[1], -0.5, 1e-4);  // left
    EXPECT_NEAR(v.xyz[2], 0.25, 1e-4);  // up
    EXPECT_EQ(v.rgb[0], 100 + 100 * k);
    EXPECT_EQ(v.rgb[2], 100 + 100 * k);
    EXPECT_EQ(int(v.keyframe), k);
    EXPECT_EQ(int(v.observations), 3 + k);
    EXPECT_NEAR(v.idepth_sigma / v.idepth, 0.02, 1e-5);
  }
}

TEST(EdgePly, LinesComeAfterThePointsWithTheirEdges) {
  const test::TempFolder folder;
  const std::string path = folder / "edges.ply";
  edgevo::Run run = two_keyframes();
  run.keyframes[1].lines = {
      test::edge_line(run.pinhole, run.keyframes[1].T_world_cam, {0, 0, 6}, {0.4, 0, 6}, 5),
      test::edge_line(run.pinhole, run.keyframes[1].T_world_cam, {0, 1, 6}, {0, 1, 7}, 3)};
  EXPECT_EQ(write_edge_ply(run, PointFilter(), path), 2);
  const Ply ply = read_ply(path);
  ASSERT_EQ(ply.vertices.size(), 2u + 5u + 3u);
  ASSERT_EQ(ply.edges.size(), 4u + 2u);
  EXPECT_EQ(ply.edges[0], (std::pair<int32_t, int32_t>(2, 3)));
  EXPECT_EQ(ply.edges[4], (std::pair<int32_t, int32_t>(7, 8))) << "none from line to line";
  EXPECT_EQ(int(ply.vertices[0].line), -1);
  EXPECT_EQ(int(ply.vertices[2].line), 0);
  EXPECT_EQ(int(ply.vertices[9].line), 1);
  EXPECT_NEAR(ply.vertices[6].xyz[1], -0.4, 1e-4) << "right of the camera";
  EXPECT_EQ(int(ply.vertices[2].gray_dark), 40);
  EXPECT_EQ(int(ply.vertices[2].gray_bright), 200);
  EXPECT_EQ(int(ply.vertices[2].rgb[0]), 120);
}

TEST(EdgePly, HeaderStatesTheUnit) {
  const test::TempFolder folder;
  const std::string path = folder / "edges.ply";
  edgevo::Run run = two_keyframes();
  write_edge_ply(run, PointFilter(), path);
  EXPECT_THAT(read_ply(path).header, HasSubstr("comment unit: arbitrary"));
  run.scale_source = "odometry";
  write_edge_ply(run, PointFilter(), path);
  EXPECT_THAT(read_ply(path).header, HasSubstr("comment unit: metre (scale from odometry)"));
}

TEST(EdgePly, EmptyRunGivesAFileWithoutVertices) {
  const test::TempFolder folder;
  const std::string path = folder / "edges.ply";
  EXPECT_EQ(write_edge_ply(edgevo::Run(), PointFilter(), path), 0);
  const Ply ply = read_ply(path);
  EXPECT_THAT(ply.header, HasSubstr("element vertex 0\n"));
  EXPECT_TRUE(ply.vertices.empty());
}

}  // namespace
}  // namespace edgevo
