// SPDX-License-Identifier: BSD-3-Clause
// Order and names of image files.
#include "edgevo/files/image_names.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

TEST(ImageNames, NumbersCompareAsNumbers) {
  for (const auto& [before, after] :
       {std::pair("img2", "img10"), std::pair("009", "10"), std::pair("a1b2", "a1b10"),
        std::pair("1305031102.175304", "1305031102.211214"), std::pair("a", "b")}) {
    EXPECT_TRUE(natural_less(before, after)) << before << " " << after;
    EXPECT_FALSE(natural_less(after, before)) << before << " " << after;
  }
  EXPECT_FALSE(natural_less("7", "7"));
}

TEST(ImageNames, AFrameIsNamedAfterItsFileOrItsNumber) {
  Frame frame;
  frame.index = 12;
  EXPECT_EQ(image_name(frame), "000012");
  frame.image_path = "/data/rgb/1305031102.175304.png";
  EXPECT_EQ(image_name(frame), "1305031102.175304");
  EXPECT_EQ(padded_number(1234567), "1234567");
}

}  // namespace
}  // namespace edgevo
