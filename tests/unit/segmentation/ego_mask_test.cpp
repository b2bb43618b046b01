// SPDX-License-Identifier: BSD-3-Clause
// Masks that are given as a file.
#include "ego_mask.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgcodecs.hpp>

#include "edgevo/core/error.h"
#include "edgevo/edges/opencv_view.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

constexpr int kMaskWidth = 480, kMaskHeight = 320;

TEST(ReadMask, ScalesOneOfTheSameShape) {
  const test::TempFolder folder;
  const std::string path = folder.path() + "/mask.png";
  for (const double scale : {0.5, 0.37, 1 / 0.63, 2.0}) {
    const cv::Size size(int(std::lround(scale * kMaskWidth)), int(std::lround(scale * kMaskHeight)));
    cv::Mat large(size, CV_8U, cv::Scalar(255));
    large(cv::Rect(0, 0, size.width / 2, size.height)) = 0;
    cv::imwrite(path, large);
    const Plane<uint8_t> mask = read_mask(path, kMaskWidth, kMaskHeight);
    EXPECT_EQ(mask.at(kMaskWidth / 2 - 4, 100), 255) << scale;
    EXPECT_EQ(mask.at(kMaskWidth / 2 + 4, 100), 0) << scale;
    EXPECT_NEAR(cv::countNonZero(as_mat(mask)), kMaskWidth * kMaskHeight / 2, 2 * kMaskHeight) << scale;
  }
}

// Programs round sides up, down or to the nearest pixel.
TEST(ReadMask, ScalesHoweverTheSidesWereRounded) {
  const test::TempFolder folder;
  const std::string path = folder.path() + "/mask.png";
  const auto accepts = [&](const cv::Size& mask, const cv::Size& images) {
    cv::Mat half(mask, CV_8U, cv::Scalar(255));
    half.rowRange(0, mask.height / 2) = 0;
    cv::imwrite(path, half);
    EXPECT_EQ(read_mask(path, images.width, images.height).at(5, 5), 255) << mask << images;
  };
  for (const int width : {620, 621})
    for (const int height : {188, 189}) {
      accepts({width, height}, {1241, 377});
      accepts({width, height}, {621, 189});
      accepts({1241, 377}, {width, height});
    }
  accepts({620, 188}, {621, 188});
}

TEST(ReadMask, TransparencyIsADrawing) {
  const test::TempFolder folder;
  const std::string path = folder.path() + "/mask.png";
  for (const int gray : {120, 255}) {
    cv::Mat drawn(kMaskHeight, kMaskWidth, CV_8UC4, cv::Scalar(gray, gray, gray, 255));
    drawn.rowRange(0, 40) = cv::Scalar(gray, gray, gray, 0);
    cv::imwrite(path, drawn);
    const Plane<uint8_t> mask = read_mask(path, kMaskWidth, kMaskHeight);
    EXPECT_EQ(mask.at(5, 39), 255) << gray;
    EXPECT_EQ(mask.at(5, 40), 0) << gray;
  }
  cv::Mat both(kMaskHeight, kMaskWidth, CV_8UC4, cv::Scalar(255, 255, 255, 255));
  both.rowRange(0, 40) = cv::Scalar(0, 0, 0, 0);
  both.rowRange(60, 70) = cv::Scalar(0, 0, 0, 255);
  both.rowRange(70, 71) = cv::Scalar(90, 90, 90, 255);
  cv::imwrite(path, both);
  const Plane<uint8_t> mask = read_mask(path, kMaskWidth, kMaskHeight);
  EXPECT_EQ(mask.at(5, 39), 255) << "transparent";
  EXPECT_EQ(mask.at(5, 65), 255) << "black";
  EXPECT_EQ(mask.at(5, 50) + mask.at(5, 70), 0);
  both.rowRange(40, kMaskHeight) = cv::Scalar(0, 0, 0, 255);
  cv::imwrite(path, both);
  EXPECT_THROW(read_mask(path, kMaskWidth, kMaskHeight), InputError) << "which of the two?";
  cv::imwrite(path, cv::Mat(kMaskHeight, kMaskWidth, CV_8UC4, cv::Scalar(255, 255, 255, 0)));
  EXPECT_THROW(read_mask(path, kMaskWidth, kMaskHeight), InputError) << "transparent all over";
}

TEST(ReadMask, RefusesAnotherShapeAndMasksOfNothingOrEverything) {
  const test::TempFolder folder;
  const std::string path = folder.path() + "/mask.png";
  const auto refuses = [&](const cv::Mat& mask) {
    cv::imwrite(path, mask);
    EXPECT_THROW(read_mask(path, kMaskWidth, kMaskHeight), InputError);
  };
  cv::Mat other(kMaskHeight, kMaskWidth + 4, CV_8U, cv::Scalar(255));
  other.at<uint8_t>(0, 0) = 0;
  refuses(other);
  refuses(cv::Mat(kMaskHeight, kMaskWidth, CV_8U, cv::Scalar(255)));
  refuses(cv::Mat(kMaskHeight, kMaskWidth, CV_8U, cv::Scalar(0)));
  EXPECT_THROW(read_mask(folder.path() + "/missing.png", kMaskWidth, kMaskHeight), InputError);
}

}  // namespace
}  // namespace edgevo
