// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/output_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <clocale>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "edgevo/core/error.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;

class OutputFiles : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return folder_ / name; }
  static std::string content(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }
  template <class Work>
  static std::string message_of(Work work) {
    try {
      work();
    } catch (const InputError& e) {
      return e.what();
    }
    return "no InputError";
  }

  test::TempFolder folder_;
};

TEST_F(OutputFiles, KeepsEveryByte) {
  std::string bytes;
  for (int i = 0; i < 100000; ++i) bytes.push_back(char(i * 7));
  OutputFile out(path("a.bin"));
  out.write(std::string_view(bytes).substr(0, 33333));
  out.write(std::string_view(bytes).substr(33333));
  out.close();
  EXPECT_EQ(content(path("a.bin")), bytes);
}

TEST_F(OutputFiles, OverwritesAnExistingFile) {
  write_file(path("a.txt"), "a long first content");
  write_file(path("a.txt"), "short");
  EXPECT_EQ(content(path("a.txt")), "short");
}

// A few bytes stay in the buffer until the close; many fail at once. Both must be reported.
TEST_F(OutputFiles, FullDiskIsReportedByCloseAtTheLatest) {
  std::filesystem::create_symlink("/dev/full", path("frames.csv"));
  const std::string expected =
      path("frames.csv") +
      ": cannot be written: No space left on device; free space or give another -o; what was "
      "written so far is kept";
  EXPECT_EQ(message_of([&] { write_file(path("frames.csv"), "few"); }), expected);
  EXPECT_EQ(message_of([&] {
              OutputFile out(path("frames.csv"));
              for (int i = 0; i < 100; ++i) out.write(std::string(100000, 'x'));
            }),
            expected);
}

TEST_F(OutputFiles, MissingFolderIsAnError) {
  EXPECT_THAT(message_of([&] { write_file(path("no/such/a.txt"), "x"); }),
              HasSubstr("No such file or directory"));
}

TEST_F(OutputFiles, OutputFolderIsCreatedWithItsParents) {
  make_output_folder(path("a/b/c"));
  EXPECT_TRUE(std::filesystem::is_directory(path("a/b/c")));
  make_output_folder(path("a/b/c/"));  // an existing folder is fine
}

TEST_F(OutputFiles, OutputFolderThatIsAFileIsAnError) {
  write_file(path("out"), "x");
  EXPECT_THAT(message_of([&] { make_output_folder(path("out")); }),
              HasSubstr("is a file, but a folder is needed"));
  EXPECT_THAT(message_of([&] { make_output_folder(path("out/deeper")); }), HasSubstr("cannot be created"));
}

TEST(FixedNumber, RoundsAndNeverPrintsMinusZero) {
  EXPECT_EQ(fixed(1.23456, 3), "1.235");
  EXPECT_EQ(fixed(-2.5, 2), "-2.50");
  EXPECT_EQ(fixed(-1e-9, 3), "0.000");
  EXPECT_EQ(fixed(-0.0, 0), "0");
  EXPECT_EQ(fixed(std::numeric_limits<double>::quiet_NaN(), 3), "nan");
  EXPECT_EQ(fixed(1e300, 1).size(), 303u);
}

}  // namespace
}  // namespace edgevo
