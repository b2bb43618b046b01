// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/error.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

TEST(InputError, MessageIsWhereWhatRemedy) {
  EXPECT_STREQ(InputError("a.txt:3", "is broken", "mend it").what(), "a.txt:3: is broken; mend it");
  EXPECT_STREQ(InputError("a.txt", "is broken", "").what(), "a.txt: is broken");
}

TEST(NearestName, IsTheOneWithTheSmallestEditDistance) {
  const std::vector<std::string> names{"mapping.window", "mapping.points", "edges.percentile"};
  EXPECT_EQ(nearest_name("maping.windw", names), "mapping.window");
  EXPECT_EQ(nearest_name("percentile", names), "edges.percentile");
  EXPECT_EQ(nearest_name("mapping.points", names), "mapping.points");
  EXPECT_EQ(nearest_name("x", {}), "");
  EXPECT_EQ(nearest_name("kitten", {"sitten", "mitten", "sitting"}), "sitten");  // the first of equals
}

}  // namespace
}  // namespace edgevo
