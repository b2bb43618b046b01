// SPDX-License-Identifier: BSD-3-Clause
// Validation of forests, which OpenCV reads unchecked.
#include "forest_model.h"

#include <gmock/gmock.h>

#include <limits>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "support/temp_folder.h"
#include "support/tiny_forest.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;

// Error of validate_forest() for the tiny forest after `corrupt`; empty if there is none.
template <class Corrupt>
std::string forest_error(const Corrupt& corrupt) {
  ForestModel m = test::tiny_forest();
  corrupt(m);
  try {
    validate_forest(m, "f.yml");
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(ForestModel, AValidForestIsAccepted) {
  EXPECT_EQ(forest_error([](ForestModel&) {}), "");
  EXPECT_NO_THROW(validate_forest(parse_forest(test::forest_text(test::tiny_forest()), "f"), "f"));
}

TEST(ForestModel, OptionsOutOfRangeAreRejected) {
  EXPECT_THAT(forest_error([](ForestModel& m) { m.options.stride = 0; }), HasSubstr("options.stride is 0"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.options.shrinkNumber = 0; }),
              HasSubstr("options.shrinkNumber"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.options.shrinkNumber = 3; }), HasSubstr("do not fit"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.options.patchInnerSize = 16; }), HasSubstr("do not fit"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.options.patchSize = 1 << 30; }), HasSubstr("patchSize"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.options.stride = 5; }),
              HasSubstr("larger than patchInnerSize"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.options.numberOfGradientOrientations = -4; }),
              HasSubstr("Orientations"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.options.regFeatureSmoothingRadius = -1; }),
              HasSubstr("regFeature"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.options.numberOfTreesToEvaluate = 3; }),
              HasSubstr("ToEvaluate"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.options.numberOfTrees = 0; }), HasSubstr("numberOfTrees"));
}

TEST(ForestModel, RowsOfUnequalLengthAreRejected) {
  EXPECT_THAT(forest_error([](ForestModel& m) { m.options.numberOfTrees = 3; }), HasSubstr("3 trees"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.childs[1].push_back(0); }), HasSubstr("tree 1"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.featureIds[0].pop_back(); }), HasSubstr("the same length"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.thresholds[1].clear(); }), HasSubstr("the same length"));
  EXPECT_THAT(forest_error([](ForestModel& m) {
                m.childs[0].clear(), m.featureIds[0].clear(), m.thresholds[0].clear();
              }),
              HasSubstr("has none"));
}

TEST(ForestModel, ChildrenThatLeaveTheTreeOrLoopAreRejected) {
  EXPECT_THAT(forest_error([](ForestModel& m) { m.childs[0][0] = 3; }),
              HasSubstr("tree 0, node 0: child 3 is out of range"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.childs[1][0] = -1; }), HasSubstr("child -1"));
  // The first child would be the node itself: an endless walk.
  EXPECT_THAT(forest_error([](ForestModel& m) { m.childs[0][0] = 1; }), HasSubstr("child 1"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.childs[0][2] = 2; }), HasSubstr("node 2"));
}

TEST(ForestModel, FeaturesAndThresholdsOutOfRangeAreRejected) {
  // 13 channels of 8 x 8 pixels, plus 13 channels of the six pairs of a grid of 2 x 2.
  const int features = 13 * (64 + 6);
  EXPECT_EQ(forest_error([&](ForestModel& m) { m.featureIds[0][0] = features - 1; }), "");
  EXPECT_THAT(forest_error([&](ForestModel& m) { m.featureIds[0][0] = features; }),
              HasSubstr("feature 910 is out of range"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.featureIds[1][2] = -1; }), HasSubstr("feature -1"));
  EXPECT_THAT(
      forest_error([](ForestModel& m) { m.thresholds[0][0] = std::numeric_limits<float>::quiet_NaN(); }),
      HasSubstr("threshold"));
}

TEST(ForestModel, EdgesOutOfRangeAreRejected) {
  EXPECT_THAT(forest_error([](ForestModel& m) { m.edgeBoundaries[1].pop_back(); }),
              HasSubstr("6 edgeBoundaries for 6 nodes"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.edgeBoundaries[0][2] = 2; }), HasSubstr("ascend"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.edgeBoundaries[1][3] = 3; }), HasSubstr("ascend"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.edgeBoundaries[0][0] = -1; }), HasSubstr("ascend"));
  EXPECT_EQ(forest_error([](ForestModel& m) { m.edgeBins[0][0] = 4 * 4 * 13 - 1; }), "");
  EXPECT_THAT(forest_error([](ForestModel& m) { m.edgeBins[0][0] = 4 * 4 * 13; }), HasSubstr("edge bin 208"));
  EXPECT_THAT(forest_error([](ForestModel& m) { m.edgeBins[1][0] = -1; }), HasSubstr("edge bin -1"));
}

std::string parse_error(const std::string& text) {
  try {
    validate_forest(parse_forest(text, "f.yml"), "f.yml");
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(ForestModel, AnotherFileFormatIsRejected) {
  const std::string good = test::forest_text(test::tiny_forest());
  EXPECT_THAT(parse_error("hello"), HasSubstr("not a structured forest"));
  EXPECT_THAT(parse_error(""), HasSubstr("not a structured forest"));
  EXPECT_THAT(parse_error("%YAML:1.0\n---\na: 1\n"), HasSubstr("no 'options'"));
  EXPECT_THAT(parse_error(good.substr(0, good.find("edgeBins"))), HasSubstr("no list 'edgeBins'"));
  std::string without_stride = good;
  without_stride.replace(good.find("stride"), 6, "strode");
  EXPECT_THAT(parse_error(without_stride), HasSubstr("stride is missing"));
  std::string text_for_number = good;
  text_for_number.replace(good.find("0.8"), 3, "abc");
  EXPECT_THAT(parse_error(text_for_number), HasSubstr("thresholds is missing or of another type"));
}

TEST(ForestModel, AMissingOrEmptyFileIsRejected) {
  test::TempFolder folder;
  EXPECT_THROW(read_forest(folder / "none.yml.gz"), InputError);
  EXPECT_THROW(read_forest(folder.path()), InputError);
  write_file(folder / "empty.yml.gz", "");
  EXPECT_THROW(read_forest(folder / "empty.yml.gz"), InputError);
}

}  // namespace
}  // namespace edgevo
