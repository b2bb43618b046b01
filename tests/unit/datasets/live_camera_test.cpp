// SPDX-License-Identifier: BSD-3-Clause
// A live camera without hardware: a grabber that delivers a video's images, or none.
#include <gmock/gmock.h>

#include <opencv2/videoio.hpp>

#include "edgevo/core/error.h"
#include "support/temp_folder.h"
#include "video_source.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;

constexpr int kWidth = 64, kHeight = 48;

Camera camera() {
  Camera c;
  c.set_pinhole({60, 60, 31.5, 23.5, kWidth, kHeight});
  return c;
}

SourceOptions camera_zero() {
  SourceOptions options;
  options.path = "camera:0";
  return options;
}

std::string error_of(ImageSource& source) {
  try {
    source.next();
  } catch (const InputError& e) {
    return e.what();
  }
  return "no error";
}

// Colour images whose gray value encodes their number, then none, as from an unplugged camera.
GrabImage images(int count, cv::Size size = {kWidth, kHeight}) {
  return [count, size, given = 0](cv::Mat* pixels) mutable {
    if (given == count) return false;
    *pixels = cv::Mat(size, CV_8UC3, cv::Scalar::all(10 * given++));
    return true;
  };
}

TEST(LiveCamera, DeliversImagesAsTheyArrive) {
  const auto source = play_live(camera_zero(), camera(), images(3));
  EXPECT_FALSE(source->size());
  std::optional<Timestamp> before;
  for (int i = 0; i < 3; ++i) {
    const auto frame = source->next();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->index, i);
    EXPECT_EQ(frame->image.width, kWidth);
    EXPECT_EQ(frame->image.pixels[100], 10 * i);
    if (before) {
      EXPECT_LT(*before, frame->time);
    }
    before = frame->time;
  }
}

TEST(LiveCamera, ReportsWhenItStops) {
  const auto source = play_live(camera_zero(), camera(), images(2));
  source->next();
  source->next();
  EXPECT_THAT(error_of(*source), HasSubstr("camera:0, frame 2: the camera gives no image; check"));
  EXPECT_FALSE(source->next());  // at its end
}

TEST(LiveCamera, ReportsACalibrationOfAnotherSize) {
  const auto source = play_live(camera_zero(), camera(), images(2, {32, 24}));
  EXPECT_THAT(error_of(*source),
              HasSubstr("camera:0, frame 0: the image is 32x24, but the camera model is for 64x48"));
}

TEST(LiveCamera, PlaysWhatOpenCvCaptures) {
  const test::TempFolder folder;
  const std::string path = folder / "video.avi";
  {
    cv::VideoWriter writer(path, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 10, {kWidth, kHeight});
    ASSERT_TRUE(writer.isOpened());
    for (int i = 0; i < 5; ++i) writer.write(cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar::all(40 * i)));
  }
  auto capture = std::make_shared<cv::VideoCapture>(path);
  const auto source =
      play_live(camera_zero(), camera(), [capture](cv::Mat* pixels) { return capture->read(*pixels); });
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(source->next()->image.pixels[0], 40 * i, 3);
  EXPECT_THAT(error_of(*source), HasSubstr("frame 5: the camera gives no image"));
}

}  // namespace
}  // namespace edgevo
