// SPDX-License-Identifier: BSD-3-Clause
#include "map_packing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "support/synthetic_run.h"

namespace edgevo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<MapVertex> row_of_points(size_t count) {
  std::vector<MapVertex> vertices(count);
  for (size_t i = 0; i < count; ++i)
    vertices[i] = {
        {float(i), float(i % 7), -1.0f}, 0.01f * float(1 + i % 50), uint8_t(i), false, int(i / 100)};
  return vertices;
}

// The bytes of one entry of the JSON.
std::string bytes_of(const std::string& json, const std::string& name) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const size_t begin = json.find("\"" + name + "\":\"") + name.size() + 4;
  std::string bytes;
  unsigned bits = 0, have = 0;
  for (size_t i = begin; json[i] != '"' && json[i] != '='; ++i) {
    bits = bits << 6 | unsigned(digits.find(json[i])), have += 6;
    if (have >= 8) bytes += char(bits >> (have -= 8) & 255);
  }
  return bytes;
}

template <typename T>
std::vector<T> values_of(const std::string& json, const std::string& name) {
  const std::string bytes = bytes_of(json, name);
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return values;
}

double number_of(const std::string& json, const std::string& name) {
  return std::atof(json.c_str() + json.find("\"" + name + "\":") + name.size() + 3);
}

TEST(MapPacking, PositionsAreExactToOneStepOfTheirBlock) {
  MapView view;
  view.vertices = row_of_points(3000);
  view.vertices[2500].position = {1e6f, 0, 0};  // an outlier must not reduce the precision of the others
  const std::string json = packed(view);
  const auto steps = values_of<uint16_t>(json, "positions");
  const auto boxes = values_of<float>(json, "boxes");
  const size_t block = size_t(number_of(json, "block"));
  ASSERT_EQ(steps.size(), 9000u);
  for (size_t i = 0; i < 2 * block; ++i)
    for (size_t k = 0; k < 3; ++k) {
      const float* box = &boxes[6 * (i / block)];
      EXPECT_NEAR(box[k] + float(steps[3 * i + k]) * box[3 + k], view.vertices[i].position[int(k)], 0.011)
          << i;
    }
}

TEST(MapPacking, SigmasKeepTheirRatio) {
  MapView view;
  view.vertices = row_of_points(200);
  view.vertices[3].sigma = 0;  // unknown
  const std::string json = packed(view);
  const std::string codes = bytes_of(json, "sigma");
  const double low = number_of(json, "sigma_low"), ratio = number_of(json, "sigma_high") / low;
  EXPECT_EQ(codes[3], 0);
  for (size_t i = 4; i < 200; ++i)
    EXPECT_NEAR(low * std::pow(ratio, (double(uint8_t(codes[i])) - 1) / 254) / double(view.vertices[i].sigma),
                1, 0.01);
}

TEST(MapPacking, HostsAndJoints) {
  MapView view;
  view.vertices = row_of_points(300);
  for (int i : {1, 2, 9}) view.vertices[size_t(i)].joined = true;
  const std::string json = packed(view);
  EXPECT_THAT(values_of<int32_t>(json, "hosts"), ElementsAre(100, 0, 100, 1, 100, 2));
  const std::string bits = bytes_of(json, "joined");
  EXPECT_EQ(bits.size(), 38u);
  EXPECT_EQ(int(bits[0]), 2 + 4);
  EXPECT_EQ(int(bits[1]), 2);
}

TEST(MapPacking, GapsOfThePathAreNaN) {
  MapView view;
  view.path = {Eigen::Vector3d(1, 2, 3), std::nullopt};
  const auto path = values_of<float>(packed(view), "path");
  EXPECT_EQ(path[2], 3);
  EXPECT_TRUE(std::isnan(path[3]));
}

TEST(MapPacking, AFullMapFitsIntoThePage) {
  MapView view;
  view.vertices = row_of_points(kMaxMapVertices);
  for (size_t i = 0; i < view.vertices.size(); ++i) view.vertices[i].joined = i % 5 != 0;
  EXPECT_LT(packed(view).size(), 3'500'000u);
}

TEST(MapPacking, ThinsEvenly) {
  const std::vector<MapVertex> thin = thinned(row_of_points(10000), 2500);
  ASSERT_EQ(thin.size(), 2500u);
  for (size_t i = 1; i < thin.size(); ++i)
    EXPECT_NEAR(thin[i].position.x() - thin[i - 1].position.x(), 4, 1.01);
}

TEST(MapPacking, ThinsLinesAsAWhole) {
  std::vector<MapVertex> lines = row_of_points(10000);
  for (size_t i = 0; i < lines.size(); ++i) lines[i].joined = i % 10 != 0;  // of ten vertices
  const std::vector<MapVertex> thin = thinned(lines, 3000);
  EXPECT_EQ(thin.size(), 3000u);
  for (size_t i = 0; i < thin.size(); ++i) {
    EXPECT_EQ(thin[i].joined, i % 10 != 0);
    if (thin[i].joined) {
      EXPECT_EQ(thin[i].position.x(), thin[i - 1].position.x() + 1);
    }
  }
}

TEST(MapPacking, ThinsOneVeryLongLine) {
  std::vector<MapVertex> line = row_of_points(10000);
  for (size_t i = 1; i < line.size(); ++i) line[i].joined = true;
  const std::vector<MapVertex> thin = thinned(line, 5000);
  EXPECT_LE(thin.size(), 5000u);
  EXPECT_GE(thin.size(), 4700u);
  for (size_t i = 1; i < thin.size(); ++i)
    EXPECT_EQ(thin[i].joined, thin[i].position.x() == thin[i - 1].position.x() + 1)
        << "no line across dropped vertices";
}

TEST(MapView, ReportsDroppedVertices) {
  MapView view;
  view.unit = "m";
  view.vertices = row_of_points(kMaxMapVertices + 1000);
  EXPECT_THAT(draw(view), HasSubstr("300000 vertices of the map, taken evenly from 301000"));
  EXPECT_EQ(draw(MapView()), "");
}

TEST(MapView, HasThePointsOfTheMapFiles) {
  const test::SyntheticRun made = test::synthetic_run();
  const PointFilter filter;
  const std::vector<MapVertex> vertices = map_points(made.run, filter);
  EXPECT_EQ(int(vertices.size()), count_points(made.run, filter).kept);
  for (const MapVertex& v : vertices) {
    EXPECT_NEAR(std::max(std::abs(v.position.y()) / 2, std::abs(v.position.z()) / 1.5f), 1, 1e-3)
        << "on a wall of the corridor";
    EXPECT_LT(v.sigma / (v.position -
                         made.run.keyframes[size_t(v.keyframe)].T_world_cam.translation().cast<float>())
                            .norm(),
              3);
  }
}

}  // namespace
}  // namespace edgevo
