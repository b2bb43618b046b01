// SPDX-License-Identifier: BSD-3-Clause
// Damage of image files, detected without decoding.
#include "edgevo/files/image_integrity.h"

#include <gtest/gtest.h>

namespace edgevo {
namespace {

std::string pixels(size_t n) { return std::string(n, 'x'); }

TEST(ImageIntegrity, APnmMustHaveAllPixelsOfItsHeader) {
  EXPECT_EQ(image_damage("P5\n4 3\n255\n" + pixels(12)), "");
  EXPECT_EQ(image_damage("P5 # by hand\n4 # wide\n 3\n255\n" + pixels(12)), "");
  EXPECT_EQ(image_damage("P5\n4 3\n255\n" + pixels(11)), "the file is cut short");
  EXPECT_EQ(image_damage("P5\n4 3\n65535\n" + pixels(24)), "");
  EXPECT_EQ(image_damage("P5\n4 3\n65535\n" + pixels(23)), "the file is cut short");
  EXPECT_EQ(image_damage("P6\n4 3\n255\n" + pixels(36)), "");
  EXPECT_EQ(image_damage("P6\n4 3\n255\n" + pixels(35)), "the file is cut short");
  EXPECT_EQ(image_damage("P4\n9 2\n" + pixels(4)), "");
  EXPECT_EQ(image_damage("P4\n9 2\n" + pixels(3)), "the file is cut short");
  EXPECT_EQ(image_damage("P2\n2 2\n9\n1 2 3 4\n"), "");
  EXPECT_EQ(image_damage("P5\n30000 30000\n255\n"), "the file is cut short");
}

TEST(ImageIntegrity, APnmHeaderNeedsThreePositiveNumbers) {
  for (const char* header : {"P5\n-5 -5\n0\n", "P5\n4 3\n0\n", "P5\n4 3\n70000\n", "P5\n", "P5\n4",
                             "P6\n0 3\n255\n", "P5\n99999999999999999999 1\n255\n", "P5\n# no end"})
    EXPECT_NE(image_damage(header + pixels(100)), "") << header;
}

TEST(ImageIntegrity, ABmpMustHaveTheSizeOfItsHeader) {
  std::string bmp = "BM" + std::string("\x40\0\0\0", 4) + pixels(58);
  EXPECT_EQ(image_damage(bmp), "");
  bmp.pop_back();
  EXPECT_EQ(image_damage(bmp), "the file is cut short");
  EXPECT_EQ(image_damage("BM"), "the file is cut short");
}

TEST(ImageIntegrity, UnknownFormatsAreAccepted) {
  EXPECT_EQ(image_damage("GIF89a"), "");
  EXPECT_EQ(image_damage("P5x"), "");
  EXPECT_EQ(image_damage(""), "the file is empty");
}

}  // namespace
}  // namespace edgevo
