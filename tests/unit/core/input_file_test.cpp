// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/input_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

std::string read_error_of(const std::string& path) {
  try {
    read_file(path, "give another");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(ReadFile, ReturnsEveryByte) {
  std::string bytes;
  for (int i = 0; i < 200000; ++i) bytes.push_back(char(i * 31));
  const test::TempFolder folder;
  const std::string path = folder / "bytes";
  write_file(path, bytes);
  EXPECT_EQ(read_file(path, ""), bytes);
  write_file(path, "");
  EXPECT_EQ(read_file(path, ""), "");
}

TEST(ReadFile, ReportsTheReasonOfFailure) {
  EXPECT_EQ(read_error_of("/nonexistent/x"),
            "/nonexistent/x: cannot be read: No such file or directory; give another");
  EXPECT_THAT(read_error_of(::testing::TempDir()), ::testing::HasSubstr("cannot be read: Is a directory"));
}

TEST(ReadFile, RefusesDevicesAndPipes) {
  const test::TempFolder folder;
  const std::string pipe = folder / "pipe";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string& path : {std::string("/dev/zero"), std::string("/dev/null"), pipe})
    EXPECT_EQ(read_error_of(path),
              path + ": cannot be read: it is a device or a pipe, not a file; give another");
}

TEST(ReadText, NamesUtf16WithAndWithoutItsMark) {
  const test::TempFolder folder;
  const std::string path = folder / "text", plain = "0.1\n0.2\n";
  std::string little, big;
  for (const char c : plain) little += {c, '\0'}, big += {'\0', c};
  for (const std::string& text : {"\xFF\xFE" + little, "\xFE\xFF" + big, little, big}) {
    write_file(path, text);
    try {
      read_text(path, "");
      ADD_FAILURE() << "was read";
    } catch (const InputError& e) {
      EXPECT_EQ(e.what(), path + ": the text is UTF-16, which is not read; save it as UTF-8");
    }
  }
  for (const std::string& text : {plain, std::string("7"), std::string("\0\0\0\0", 4)}) {
    write_file(path, text);
    EXPECT_EQ(read_text(path, ""), text);
  }
}

TEST(ReadFile, RefusesFilesThatAreTooLarge) {
  const test::TempFolder folder;
  const std::string path = folder / "large";
  write_file(path, "");
  std::filesystem::resize_file(path, uintmax_t(5) << 30);  // sparse: takes no space
  EXPECT_THAT(read_error_of(path), ::testing::HasSubstr("it is larger than 2 GB"));
}

}  // namespace
}  // namespace edgevo
