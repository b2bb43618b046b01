// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/edges/exposure_check.h"

#include <gtest/gtest.h>

#include "edgevo/core/random.h"

namespace edgevo {
namespace {

constexpr int kWidth = 96, kHeight = 64;

// A texture that has moved to the right by `shift` pixels.
GrayImage view(int shift) {
  GrayImage image{kWidth, kHeight, {}};
  for (int y = 0; y < kHeight; ++y) {
    Random random(uint64_t(y / 4) + 1);
    std::vector<uint8_t> blocks;
    for (int i = 0; i < 64; ++i) blocks.push_back(uint8_t(random.below(256)));
    for (int x = 0; x < kWidth; ++x) image.pixels.push_back(blocks[size_t((x + 200 - shift) / 5)]);
  }
  return image;
}

void copy_rows(const GrayImage& from, int begin, int end, int step, GrayImage* to) {
  for (int y = begin; y < end; y += step)
    std::copy_n(&from.pixels[size_t(y * kWidth)], kWidth, &to->pixels[size_t(y * kWidth)]);
}

GrayImage even(uint8_t value) {
  return {kWidth, kHeight, std::vector<uint8_t>(size_t(kWidth * kHeight), value)};
}

TEST(ExposureCheck, ATornImageIsFoundWithItsRows) {
  ExposureCheck check;
  check.add(view(0));
  check.add(view(3));
  GrayImage torn = view(6);
  copy_rows(view(3), 40, kHeight, 1, &torn);
  const ImageExposure found = check.add(torn);
  EXPECT_EQ(found.fault, ImageFault::kTorn);
  EXPECT_EQ(found.old_rows.begin, 40);
  EXPECT_EQ(found.old_rows.end, kHeight);
  EXPECT_EQ(check.add(view(9)).fault, ImageFault::kNone);
  GrayImage upper = view(12);
  copy_rows(view(9), 0, 20, 1, &upper);
  EXPECT_EQ(check.add(upper).old_rows.end, 20);
}

TEST(ExposureCheck, APartMayBeOfAnyBufferOfTheDriver) {
  for (const int age : {2, 3, 4}) {
    ExposureCheck check;
    for (int i = 0; i < 7; ++i) check.add(view(3 * i));
    GrayImage torn = view(21);
    copy_rows(view(21 - 3 * age), 0, 30, 1, &torn);
    const ImageExposure found = check.add(torn);
    EXPECT_EQ(found.fault, ImageFault::kTorn) << age;
    EXPECT_EQ(found.old_rows.begin, 0);
    EXPECT_EQ(found.old_rows.end, 30);
    for (int i = 8; i < 14; ++i)
      EXPECT_EQ(check.add(view(3 * i)).fault, ImageFault::kNone) << age << " " << i;
  }
}

TEST(ExposureCheck, ThereAndBackIsNoTear) {
  ExposureCheck check;
  for (int i = 0; i < 6; ++i) EXPECT_EQ(check.add(view(3 * (i % 2))).fault, ImageFault::kNone) << i;
}

TEST(ExposureCheck, WhatIsFixedToTheCameraIsNoTear) {
  ExposureCheck check;
  for (int i = 0; i < 5; ++i) {
    GrayImage image = view(3 * i);
    copy_rows(view(0), 44, kHeight, 1, &image);
    EXPECT_EQ(check.add(image).fault, ImageFault::kNone) << i;
  }
}

TEST(ExposureCheck, AWhiteSkyIsNoTear) {
  ExposureCheck check;
  for (int i = 0; i < 4; ++i) {
    GrayImage image = view(3 * i);
    copy_rows(i == 1 ? view(40) : even(255), 0, 20, 1, &image);
    EXPECT_EQ(check.add(image).fault, ImageFault::kNone) << i;
  }
}

TEST(ExposureCheck, OnlyTheFirstOfSeveralIsAFault) {
  ExposureCheck check;
  check.add(view(0));
  check.add(view(3));
  EXPECT_EQ(check.add(view(3)).fault, ImageFault::kRepeated);
  EXPECT_EQ(check.add(view(3)).fault, ImageFault::kNone) << "the camera stands";
  EXPECT_EQ(check.add(view(6)).fault, ImageFault::kNone);
  EXPECT_EQ(check.add(even(3)).fault, ImageFault::kBlank);
  EXPECT_EQ(check.add(even(3)).fault, ImageFault::kNone) << "something covers the lens";
  EXPECT_EQ(check.add(view(9)).fault, ImageFault::kNone);
  EXPECT_EQ(check.add(even(255)).fault, ImageFault::kBlank);
}

TEST(ExposureCheck, InterlacedImagesAreFoundAndOneFieldIsLeft) {
  ExposureCheck check;
  GrayImage last;
  for (int i = 0; i < 3; ++i) {
    last = view(6 * i);
    copy_rows(view(6 * i - 3), 1, kHeight, 2, &last);
    EXPECT_EQ(check.add(last).fault, ImageFault::kInterlaced) << i;
  }
  EXPECT_EQ(check.pattern(), ImageFault::kInterlaced);
  const GrayImage field = first_field(last), whole = view(12);
  EXPECT_TRUE(std::equal(field.pixels.begin(), field.pixels.begin() + kWidth, whole.pixels.begin()));
  EXPECT_EQ(field.pixels[kWidth], whole.pixels[0]) << "rows 0 and 2 are alike";
}

TEST(ExposureCheck, AMosaicOfColoursIsNotInterlacedAndSmoothedToGray) {
  ExposureCheck check;
  GrayImage mosaic;
  for (int i = 0; i < 3; ++i) {
    mosaic = view(3 * i);
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const int colour = y % 2 + x % 2;  // R G; G B
        uint8_t& value = mosaic.pixels[size_t(y * kWidth + x)];
        value = uint8_t(colour == 0 ? value / 2 : colour == 1 ? value : value / 4);
      }
    EXPECT_EQ(check.add(mosaic).fault, ImageFault::kMosaic) << i;
  }
  const GrayImage gray = without_mosaic(mosaic), even_mosaic = [] {
    GrayImage image = even(100);
    for (int y = 0; y < kHeight; ++y)
      for (int x = y % 2; x < kWidth; x += 2) image.pixels[size_t(y * kWidth + x)] = 50;
    return image;
  }();
  EXPECT_EQ(ExposureCheck().add(gray).fault, ImageFault::kNone);
  const GrayImage flat = without_mosaic(even_mosaic);
  EXPECT_EQ(flat.pixels, even(75).pixels);
}

TEST(ExposureCheck, AnotherSizeBeginsAnew) {
  ExposureCheck check;
  for (int i = 0; i < 3; ++i) check.add(view(3 * i));
  GrayImage turned = view(12);
  std::swap(turned.width, turned.height);
  EXPECT_NE(check.add(turned).fault, ImageFault::kTorn);
}

TEST(ExposureCheck, TheNoiseOfABareWallIsNotInterlaced) {
  Random random(1);
  ExposureCheck check;
  for (int i = 0; i < 200; ++i) {
    GrayImage wall = even(120);
    for (uint8_t& value : wall.pixels) value = uint8_t(std::lround(value + 2 * random.normal()));
    EXPECT_EQ(check.add(wall).fault, ImageFault::kNone) << i;
  }
}

}  // namespace
}  // namespace edgevo
