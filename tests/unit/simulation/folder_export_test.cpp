// SPDX-License-Identifier: BSD-3-Clause
// The written folder: its files, the same bytes from one thread and from two, poses relative to the first
// written camera.
#include "edgevo/simulation/folder_export.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <cstring>
#include <string>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

std::string content(const std::string& path) { return read_file(path, ""); }

TEST(FolderExport, BytesDoNotDependOnThreads) {
  const SceneRenderer renderer(load_scene("desk"));
  FolderExport options;
  options.begin = 10, options.end = 13, options.depth = true, options.threads = 1;
  const test::TempFolder temp;
  const std::string one = temp / "one", two = temp / "two";
  export_folder(renderer, one, options);
  options.threads = 2;
  int calls = 0;
  export_folder(renderer, two, options, [&](int done) { EXPECT_EQ(done, ++calls); });
  EXPECT_EQ(calls, 3);
  for (const char* file : {"images/000010.png", "images/000012.png", "depth/000011.pfm", "times.txt",
                           "camera.txt", "groundtruth_tum.txt", "SOURCE.md"})
    EXPECT_EQ(content(one + "/" + file), content(two + "/" + file)) << file;
}

TEST(FolderExport, FirstPoseIsTheIdentityAndDepthIsExact) {
  const SceneRenderer renderer(load_scene("desk"));
  FolderExport options;
  options.begin = 2, options.end = 4, options.depth = true;
  const test::TempFolder temp;
  const std::string folder = temp / "depth";
  export_folder(renderer, folder, options);
  EXPECT_THAT(
      content(folder + "/groundtruth_tum.txt"),
      ::testing::HasSubstr(
          "0.0666667 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 0.000000000 1.000000000\n"));
  const std::string pfm = content(folder + "/depth/000003.pfm"), header = "Pf\n640 480\n-1.0\n";
  ASSERT_EQ(pfm.size(), header.size() + 640 * 480 * 4);
  EXPECT_EQ(pfm.substr(0, header.size()), header);
  float bottom_left = 0;
  std::memcpy(&bottom_left, pfm.data() + header.size(), sizeof bottom_left);
  EXPECT_EQ(bottom_left, renderer.render_depth(3)[479 * 640]);
}

TEST(FolderExport, TheCameraOfADrawnSceneReadsBackDigitByDigit) {
  const SceneRenderer renderer(load_scene("open_land", 4));
  FolderExport options;
  options.begin = 0, options.end = 1;
  const test::TempFolder temp;
  export_folder(renderer, temp / "land", options);
  const std::string text = content(temp / "land/camera.txt");
  const double fx = std::strtod(text.c_str() + text.find('\n'), nullptr);
  EXPECT_EQ(fx, renderer.scene().camera.pinhole().fx);
}

TEST(FolderWriter, NamesThatWouldPlayInAnotherOrderAreRefused) {
  Camera camera;
  camera.set_pinhole({10, 10, 1, 1, 2, 2});
  const test::TempFolder temp;
  FolderWriter writer(temp / "out", camera);
  const auto frame = [](int i, const char* path) {
    return Frame{i, Timestamp::from_seconds(i), {2, 2, {1, 2, 3, 4}}, path};
  };
  writer.add(frame(0, "/source/img9.png"));
  writer.add(frame(1, "/source/img10.jpg"));
  EXPECT_THROW(writer.add(frame(2, "/source/img1.png")), InputError);
  writer.finish("", "");
  EXPECT_FALSE(content(temp / "out/images/img10.png").empty());
  EXPECT_EQ(content(temp / "out/times.txt"), "0.0000000\n1.0000000\n");
}

TEST(FolderExport, RangeOutsideIsRefused) {
  const SceneRenderer renderer(load_scene("desk"));
  FolderExport options;
  options.begin = 400, options.end = 100000;
  const test::TempFolder temp;
  EXPECT_THROW(export_folder(renderer, temp / "none", options), InputError);
}

}  // namespace
}  // namespace edgevo
