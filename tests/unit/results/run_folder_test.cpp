// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/results/run_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

#include "edgevo/core/output_file.h"
#include "support/temp_folder.h"
#include "support/text.h"

namespace edgevo {
namespace {

using ::testing::ElementsAre;

TEST(RunFolder, AFailureDoesNotPreventTheOtherFiles) {
  const test::TempFolder temp;
  RunFolder folder(temp / "new/parents");
  folder.attempt("a", [](const std::string&) { throw std::runtime_error("a call\nits stack"); });
  folder.attempt("b", [](const std::string& path) { write_file(path, "b"); });
  folder.attempt("c", [](const std::string& path) { throw InputError(path, "is not to be", "leave it"); });
  EXPECT_EQ(test::content(folder.path_of("b")), "b");
  EXPECT_THAT(folder.not_written(), ElementsAre("a", "c"));
  try {
    folder.throw_first_failure();
    ADD_FAILURE() << "the first failure was not thrown";
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).find(folder.path_of("a") + ": cannot be written: a call"), 0u)
        << e.what();
    EXPECT_EQ(std::string(e.what()).find("stack"), std::string::npos) << e.what();
  }
}

TEST(RunFolder, ThrowsNothingIfNothingFailed) {
  const test::TempFolder temp;
  const RunFolder folder(temp / "new");
  EXPECT_TRUE(std::filesystem::is_directory(temp / "new"));
  EXPECT_NO_THROW(folder.throw_first_failure());
}

}  // namespace
}  // namespace edgevo
