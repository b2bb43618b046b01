// SPDX-License-Identifier: BSD-3-Clause
#include <opencv2/videoio.hpp>

#include "edgevo/datasets/open_source.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

using test::TempFolder;

// Lossless (FFV1) gray video of `count` frames at 20 Hz.
void write_video(const std::string& path, int count) {
  cv::VideoWriter writer(path, cv::CAP_FFMPEG, cv::VideoWriter::fourcc('F', 'F', 'V', '1'), 20,
                         cv::Size(48, 32), true);
  ASSERT_TRUE(writer.isOpened());
  for (int i = 0; i < count; ++i) {
    cv::Mat frame(32, 48, CV_8UC3, cv::Scalar::all(10 * i));
    cv::randu(frame.rowRange(16, 32), 0, 256);  // so that a frame takes some bytes
    writer.write(frame);
  }
}

class Video : public ::testing::Test {
 protected:
  Video() {
    test::write_text(folder_ / "camera.txt", "40 40 24 16 0 0 0 0 48 32");
    options_.path = folder_ / "clip.avi";
    options_.camera_file = folder_ / "camera.txt";
  }
  TempFolder folder_;
  SourceOptions options_;
};

TEST_F(Video, GivesItsFramesAtItsRate) {
  write_video(options_.path, 12);
  const auto source = open_source(options_);
  EXPECT_EQ(source->kind(), "video");
  const auto frames = test::read_all(*source);
  ASSERT_EQ(frames.size(), 12u);
  for (int i = 0; i < 12; ++i) {
    EXPECT_EQ(frames[size_t(i)].index, i);
    EXPECT_EQ(frames[size_t(i)].time.ticks, i * 500000);
    EXPECT_NEAR(frames[size_t(i)].image.pixels[100], 10 * i, 2);  // colour space conversion of the codec
  }
  options_.every = 5;
  const auto thinned = test::read_all(*open_source(options_));
  ASSERT_EQ(thinned.size(), 3u);
  EXPECT_EQ(thinned[2].index, 10);
  EXPECT_EQ(thinned[2].time.ticks, 5000000);
}

TEST_F(Video, ATruncatedFileIsReported) {
  write_video(options_.path, 40);
  const std::string bytes = test::read_text(options_.path);
  test::write_text(options_.path, bytes.substr(0, bytes.size() * 2 / 3));
  const auto source = open_source(options_);
  EXPECT_GT(test::frames_before_error(*source, "the video is damaged"), 5);
}

// It has no frame count: only the incomplete packet reveals the cut.
TEST_F(Video, ATruncatedTransportStreamIsReported) {
  options_.path = folder_ / "clip.ts";
  cv::VideoWriter writer(options_.path, cv::CAP_FFMPEG, cv::VideoWriter::fourcc('m', 'p', 'g', '2'), 25,
                         cv::Size(48, 32), true);
  ASSERT_TRUE(writer.isOpened());
  for (int i = 0; i < 40; ++i) writer.write(cv::Mat(32, 48, CV_8UC3, cv::Scalar::all(5 * i)));
  writer.release();
  const size_t frames = test::read_all(*open_source(options_)).size();
  EXPECT_GT(frames, 30u);
  const std::string bytes = test::read_text(options_.path);
  test::write_text(options_.path, bytes.substr(0, bytes.size() * 2 / 3 / 188 * 188 + 100));
  const auto source = open_source(options_);
  EXPECT_LT(test::frames_before_error(*source, "is cut short: it ends within a packet"), int(frames));
}

}  // namespace
}  // namespace edgevo
