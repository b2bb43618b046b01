// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/occupancy/line_table.h"
#include "edgevo/core/depth_source.h"

#include <gmock/gmock.h>

#include <sstream>

#include "pole_and_wall.h"

namespace edgevo {
namespace {

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream in(row);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

TEST(LineTable, OneRowALine) {
  edgevo::Run run;
  run.pinhole = test::test_pinhole();
  run.keyframes.resize(2);
  run.keyframes[1].frame_index = 7;
  run.keyframes[1].lines = {test::edge_line(run.pinhole, SE3(), {0, 0, 6}, {0.5, 0, 6}, 5)};
  run.keyframes[1].lines[0].views = 3, run.keyframes[1].lines[0].source = DepthSource::kPlane;
  std::istringstream text(line_table_csv(run));
  std::string header, row, more;
  std::getline(text, header);
  std::getline(text, row);
  EXPECT_FALSE(std::getline(text, more));
  const std::vector<std::string> names = cells_of(header), cells = cells_of(row);
  ASSERT_EQ(cells.size(), names.size());
  const auto cell = [&](const std::string& name) {
    return cells[size_t(std::find(names.begin(), names.end(), name) - names.begin())];
  };
  EXPECT_EQ(cell("keyframe"), "1");
  EXPECT_EQ(cell("frame"), "7");
  EXPECT_EQ(cell("x1"), "6.0000") << "forward";
  EXPECT_EQ(cell("y2"), "-0.5000") << "right of the camera";
  EXPECT_EQ(cell("length"), "0.5000");
  EXPECT_EQ(cell("dy"), "-1.0000");
  EXPECT_EQ(cell("sigma"), "0.0300") << "0.005 of a depth of 6";
  EXPECT_EQ(cell("vertices"), "5");
  EXPECT_EQ(cell("straight"), "1");
  EXPECT_EQ(cell("gray_bright"), "200");
  EXPECT_EQ(cell("views"), "3");
  EXPECT_EQ(cell("source"), "plane");
}

TEST(LineTable, WithoutLinesHasOnlyTheHeader) {
  const std::string text = line_table_csv(edgevo::Run());
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
}

}  // namespace
}  // namespace edgevo
