#include "edgevo/files/program_folder.h"

#include <gmock/gmock.h>

namespace edgevo {
namespace {

TEST(ProgramFolder, HoldsThisProgram) {
  EXPECT_TRUE(std::filesystem::is_regular_file(program_folder() / "test_core"));
}

}  // namespace
}  // namespace edgevo
