// SPDX-License-Identifier: BSD-3-Clause
// Checks the order of the modules: the rules themselves on made-up files, then every file of the project.
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>

#include "edgevo/core/input_file.h"
#include "include_rules.h"

namespace edgevo::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::vector<std::string> kOrder{"core",
                                      "files",
                                      "opencv_bridge",
                                      "symphony_lake",
                                      "recordings",
                                      "gyro",
                                      "edges",
                                      "detectors",
                                      "alignment",
                                      "segmentation",
                                      "confidence",
                                      "association",
                                      "bundle_adjustment",
                                      "map",
                                      "features",
                                      "places",
                                      "kept_map",
                                      "edge_map",
                                      "self_calibration",
                                      "mapping",
                                      "tracking",
                                      "odometry",
                                      "run_quality",
                                      "scale",
                                      "occupancy",
                                      "mrpt_bridge",
                                      "visp_bridge",
                                      "mcap_output",
                                      "datasets",
                                      "calibration",
                                      "simulation",
                                      "sequence_output",
                                      "evaluation",
                                      "frame_evaluation",
                                      "map_evaluation",
                                      "facade",
                                      "study",
                                      "run_loop",
                                      "report",
                                      "results",
                                      "run_session",
                                      "benchmark",
                                      "servo",
                                      "viewer",
                                      "mrpt_plugin",
                                      "python"};

std::vector<std::string> broken(const std::string& path, const std::string& text) {
  return broken_include_rules({path, text}, kOrder);
}

TEST(IncludeRules, UpwardIncludesAreFound) {
  EXPECT_THAT(
      broken("modules/edges/src/a.cpp", "// a\n#include \"edgevo/mapping/window.h\"\n"),
      ElementsAre(
          "modules/edges/src/a.cpp:2: edgevo/mapping/window.h reaches upward: edges stands below mapping"));
  EXPECT_THAT(broken("modules/core/include/edgevo/core/a.h", "#  include <edgevo/edges/x.h>\n"),
              ElementsAre(HasSubstr("upward")));
  EXPECT_THAT(
      broken("modules/edges/src/a.cpp", "#include \"edgevo/core/se3.h\"\n#include \"edgevo/edges/x.h\"\n"),
      IsEmpty());
}

TEST(IncludeRules, SiblingsDoNotUseEachOther) {
  EXPECT_THAT(broken("modules/visp_bridge/src/a.cpp", "#include \"edgevo/mrpt_bridge/x.h\"\n"),
              ElementsAre(HasSubstr("siblings")));
  EXPECT_THAT(broken("modules/mrpt_bridge/src/a.cpp", "#include \"edgevo/occupancy/x.h\"\n"),
              ElementsAre(HasSubstr("siblings")));
  EXPECT_THAT(broken("modules/datasets/src/a.cpp", "#include \"edgevo/mrpt_bridge/x.h\"\n"), IsEmpty());
}

TEST(IncludeRules, OnlyServoUsesWhatLinksViSP) {
  const char* const feed = "#include \"edgevo/visp_bridge/servo_feed.h\"\n";
  EXPECT_THAT(broken("modules/servo/src/a.cpp", feed), IsEmpty());
  EXPECT_THAT(broken("modules/simulation/src/a.cpp", feed),
              ElementsAre(HasSubstr("brings the GPL into simulation")));
  EXPECT_THAT(broken("modules/viewer/src/a.cpp", "#include \"edgevo/servo/x.h\"\n"),
              ElementsAre(HasSubstr("the GPL")));
}

TEST(IncludeRules, LibrariesAreNotExposedByOtherModules) {
  const char* const headers[] = {"ceres/ceres.h", "octomap/OcTree.h", "mrpt/poses/CPose3D.h",
                                 "visp3/core/vpImage.h", "opencv2/core.hpp"};
  for (const char* header : headers) {
    const std::string text = std::string("#include <") + header + ">\n";
    EXPECT_THAT(broken("modules/mapping/include/edgevo/mapping/a.h", text),
                ElementsAre(HasSubstr("does not own it")))
        << header;
    EXPECT_THAT(broken("modules/mapping/src/a.cpp", text), IsEmpty()) << header;
  }
  EXPECT_THAT(broken("modules/edges/include/edgevo/edges/a.h", "#include <opencv2/core.hpp>\n"), IsEmpty());
  EXPECT_THAT(broken("modules/mrpt_bridge/include/edgevo/mrpt_bridge/a.h", "#include <mrpt/img/TCamera.h>\n"),
              IsEmpty());
  EXPECT_THAT(broken("modules/mrpt_bridge/include/edgevo/mrpt_bridge/a.h", "#include <octomap/OcTree.h>\n"),
              ElementsAre(HasSubstr("shows OctoMap")));
}

TEST(IncludeRules, PrivateFoldersStayPrivate) {
  EXPECT_THAT(broken("modules/edges/src/a.cpp", "#include \"../../core/src/block_yaml.h\"\n"),
              ElementsAre(HasSubstr("reaches into")));
  EXPECT_THAT(broken("modules/edges/src/a.cpp", "#include \"modules/core/src/block_yaml.h\"\n"),
              ElementsAre(HasSubstr("reaches into")));
}

TEST(IncludeRules, UnknownModulesAreFound) {
  EXPECT_THAT(broken("modules/nonsense/src/a.cpp", ""), ElementsAre(HasSubstr("no module")));
  EXPECT_THAT(broken("modules/edges/src/a.cpp", "#include \"edgevo/nonsense/x.h\"\n"),
              ElementsAre(HasSubstr("no module")));
}

TEST(IncludeRules, TheOrderIsReadFromCMake) {
  EXPECT_EQ(module_order("x\nset(EDGEVO_MODULES a b\n    c)\ny"), (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_THAT(module_order("nothing"), IsEmpty());
}

bool is_source(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".h" || extension == ".hpp" || extension == ".cpp";
}

TEST(IncludeRules, TheProjectFollowsThem) {
  const std::filesystem::path root = EDGEVO_SOURCE_DIR;
  const std::vector<std::string> order = module_order(read_file((root / "CMakeLists.txt").string(), ""));
  EXPECT_EQ(order, kOrder) << "the table of layers changed: change this test with it";
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / "modules")) {
    if (!entry.is_regular_file() || !is_source(entry.path())) continue;
    const std::string path = std::filesystem::relative(entry.path(), root).generic_string();
    EXPECT_THAT(broken_include_rules({path, read_file(entry.path().string(), "")}, order), IsEmpty());
    ++files;
  }
  EXPECT_GT(files, 20);
}

}  // namespace
}  // namespace edgevo::test
