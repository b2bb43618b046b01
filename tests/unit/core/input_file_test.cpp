#include "edgevo/core/input_file.h"

#include <gmock/gmock.h>

#include <string>

#include "edgevo/core/error.h"
#include "edgevo/core/output_file.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

std::string error_of(const std::string& path) {
  try {
    read_file(path, "give another");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(ReadFile, GivesEveryByteBack) {
  std::string bytes;
  for (int i = 0; i < 200000; ++i) bytes.push_back(char(i * 31));
  const test::TempFolder folder;
  const std::string path = folder / "bytes";
  write_file(path, bytes);
  EXPECT_EQ(read_file(path, ""), bytes);
  write_file(path, "");
  EXPECT_EQ(read_file(path, ""), "");
}

TEST(ReadFile, TellsWhyItCannot) {
  EXPECT_EQ(error_of("/nonexistent/x"), "/nonexistent/x: cannot be read: No such file or directory; give another");
  EXPECT_THAT(error_of(::testing::TempDir()), ::testing::HasSubstr("cannot be read: Is a directory"));
}

}  // namespace
}  // namespace edgevo
