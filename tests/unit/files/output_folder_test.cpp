// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/files/output_folder.h"

#include <gmock/gmock.h>

#include <filesystem>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

template <class Work>
std::string refusal_of(const Work& work) {
  try {
    work();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

class OutputFolder : public ::testing::Test {
 protected:
  OutputFolder() {
    fs::create_directories(in("sequence/images"));
    write_file(in("clip.rawlog"), "");
    fs::create_directories(in("clip_Images"));
  }
  std::string in(const std::string& name) const { return folder_ / name; }
  std::string apart(const std::string& source, const std::string& output) const {
    return refusal_of([&] { check_apart(in(source), in(output)); });
  }
  test::TempFolder folder_;
};

TEST_F(OutputFolder, MustNotOverlapItsSource) {
  for (const char* inside :
       {"sequence/images", "sequence/images/new", "sequence/out", "other/../sequence/out"})
    EXPECT_THAT(apart("sequence", inside), HasSubstr("lies inside its own source")) << inside;
  EXPECT_THAT(apart("sequence", "sequence/"), HasSubstr("is its own source"));
  EXPECT_THAT(apart("sequence", "."), HasSubstr("holds its own source"));
  EXPECT_THAT(apart("clip.rawlog", "clip_Images"), HasSubstr("is its own source"));
  EXPECT_THAT(apart("clip.rawlog", "clip_Images/out"), HasSubstr("lies inside its own source"));
  EXPECT_EQ(apart("sequence", "sequence_out"), "");
  EXPECT_EQ(apart("sequence/images", "sequence/out"), "");
  EXPECT_EQ(apart("clip.rawlog", "clip_out"), "");
}

TEST_F(OutputFolder, LinksAreResolved) {
  fs::create_directories(in("elsewhere"));
  fs::create_directories(in("linked"));
  fs::create_directory_symlink(in("elsewhere"), in("linked/images"));
  fs::create_directory_symlink(in("sequence"), in("alias"));
  EXPECT_THAT(apart("linked", "elsewhere/out"), HasSubstr("lies inside its own source"));
  EXPECT_THAT(apart("sequence", "alias/out"), HasSubstr("lies inside its own source"));
  EXPECT_THAT(apart("alias", "sequence/out"), HasSubstr("lies inside its own source"));
}

TEST_F(OutputFolder, ASourceThatIsNotAPathOverlapsNothing) {
  EXPECT_NO_THROW(check_apart("camera:0", in("sequence")));
  EXPECT_NO_THROW(check_apart("", in("sequence")));
}

TEST_F(OutputFolder, AnExistingFileIsKeptUnlessForced) {
  fs::create_symlink("/nowhere", in("dangling"));
  EXPECT_THAT(refusal_of([&] { check_not_there(in("clip.rawlog"), false); }),
              HasSubstr("exists already; give"));
  EXPECT_THAT(refusal_of([&] { check_not_there(in("dangling"), false); }), HasSubstr("exists already"));
  EXPECT_NO_THROW(check_not_there(in("clip.rawlog"), true));
  EXPECT_NO_THROW(check_not_there(in("new.rawlog"), false));
}

TEST_F(OutputFolder, FoldersOfOthersAreKept) {
  fs::create_directories(in("empty"));
  EXPECT_NO_THROW(check_folder_is_ours(in("empty"), {}, false));
  EXPECT_NO_THROW(check_folder_is_ours(in("nowhere"), {}, false));
  EXPECT_NO_THROW(check_folder_is_ours(in("sequence"), {"times.txt", "images"}, false));
  EXPECT_NO_THROW(check_folder_is_ours(in("sequence"), {}, true));
  EXPECT_THAT(refusal_of([&] { check_folder_is_ours(in("sequence"), {"study.md"}, false); }),
              HasSubstr("sequence: contains other files already (images); give another -o, or --force"));
}

}  // namespace
}  // namespace edgevo
