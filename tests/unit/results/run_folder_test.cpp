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

TEST(RunFolder, OneFailureDoesNotKeepTheOthersFromBeingTried) {
  const test::TempFolder temp;
  RunFolder folder(temp / "new/parents");
  folder.attempt("a", [](const std::string&) { throw std::runtime_error("a call\nits stack"); });
  folder.attempt("b", [](const std::string& path) { write_file(path, "b"); });
  folder.attempt("c", [](const std::string& path) { throw InputError(path, "is not to be", "leave it"); });
  EXPECT_EQ(test::content(folder.path_of("b")), "b");
  EXPECT_THAT(folder.not_written(), ElementsAre("a", "c"));
  try {
    folder.tell_failures();
    ADD_FAILURE() << "the first failure was not told";
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).find(folder.path_of("a") + ": cannot be written: a call"), 0u)
        << e.what();
    EXPECT_EQ(std::string(e.what()).find("stack"), std::string::npos) << e.what();
  }
}

TEST(RunFolder, TellsNothingWhereNothingFailed) {
  const test::TempFolder temp;
  const RunFolder folder(temp / "new");
  EXPECT_TRUE(std::filesystem::is_directory(temp / "new"));
  EXPECT_NO_THROW(folder.tell_failures());
}

}  // namespace
}  // namespace edgevo
