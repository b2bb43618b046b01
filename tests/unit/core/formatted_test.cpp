// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/formatted.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

TEST(Formatted, HoldsTextOfAnyLength) {
  EXPECT_EQ(formatted("%d of %s", 3, "four"), "3 of four");
  EXPECT_EQ(formatted("%s", std::string(5000, 'x').c_str()), std::string(5000, 'x'));
  EXPECT_EQ(formatted("%s", ""), "");
}

}  // namespace
}  // namespace edgevo
