// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/files/program_folder.h"

#include <gmock/gmock.h>

#include "support/temp_folder.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

TEST(ProgramFolder, ContainsThisProgram) { EXPECT_TRUE(fs::is_regular_file(program_folder() / "test_core")); }

// An installation prefix with share/edgevo in it.
class DataFolder : public ::testing::Test {
 protected:
  void SetUp() override { fs::create_directories(data_); }
  const test::TempFolder temp_;
  const fs::path prefix_ = fs::path(temp_.path()) / "prefix", data_ = prefix_ / "share/edgevo";
};

TEST_F(DataFolder, IsThatOfThePrefixOfAProgramInBin) { EXPECT_EQ(data_folder_of(prefix_ / "bin"), data_); }

TEST_F(DataFolder, IsThatOfThePrefixOfAProgramInLibexec) {
  EXPECT_EQ(data_folder_of(prefix_ / "libexec/edgevo"), data_);
  EXPECT_EQ(data_folder_of(prefix_ / "lib/x86_64-linux-gnu/edgevo"), data_);
}

TEST_F(DataFolder, IsThatOfThePrefixOfAPythonPackage) {
  EXPECT_EQ(data_folder_of(prefix_ / "lib/python3/dist-packages/edgevo"), data_);
}

TEST_F(DataFolder, DefaultsToThePrefixOfBin) {
  fs::remove(data_);
  EXPECT_EQ(data_folder_of(prefix_ / "bin"), data_);
  EXPECT_EQ(data_folder_of({}), "share/edgevo");
}

}  // namespace
}  // namespace edgevo
