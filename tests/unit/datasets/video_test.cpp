// SPDX-License-Identifier: BSD-3-Clause
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "edgevo/core/bad_frame.h"
#include "edgevo/datasets/open_source.h"
#include "unit/datasets/temp_sequence.h"
#include "unit/datasets/varying_video.h"

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

TEST_F(Video, ASingleImageIsNone) {
  options_.path = folder_ / "photo.png";
  ASSERT_TRUE(cv::imwrite(options_.path, cv::Mat(32, 48, CV_8UC1, cv::Scalar(90))));
  EXPECT_THAT(test::error_of([&] { open_source(options_); }),
              ::testing::HasSubstr("photo.png: is a single image; give the folder"));
}

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

TEST_F(Video, AnMp4WithoutItsEndIsSaidToBeOne) {
  options_.path = folder_ / "cut.mp4";
  const auto box = [](const std::string& name, size_t length, const std::string& content) {
    return std::string("\0\0\0", 3) + char(length) + name + content;
  };
  const auto is_said = [&](const std::string& bytes) {
    test::write_text(options_.path, bytes);
    const std::string said = test::error_of([&] { open_source(options_); });
    EXPECT_NE(said, "");
    return said.find("is an MP4 without its end") != std::string::npos;
  };
  const std::string type = box("ftyp", 16, "isom0000"), frames = box("mdat", 12, "0123"),
                    index = box("moov", 12, "0123"),
                    long_frames = box("mdat", 1, std::string("\0\0\0\0\0\0\0\x14", 8) + "0123");
  EXPECT_TRUE(is_said(type + box("mdat", 200, "0123456789")));
  EXPECT_TRUE(is_said(type + frames));
  EXPECT_TRUE(is_said(type + frames + box("moov", 200, "0123")));
  EXPECT_FALSE(is_said(type + frames + index)) << "damaged in another way";
  EXPECT_FALSE(is_said(type + index + box("mdat", 200, "0123")));
  EXPECT_FALSE(is_said(type + box("free", 12, "0123") + long_frames + index));
  EXPECT_FALSE(is_said(box("ftyp", 16, "heic0000") + frames)) << "a photo";
  EXPECT_FALSE(is_said(box("RIFF", 12, "0123")));
}

TEST_F(Video, ATruncatedFileIsReported) {
  write_video(options_.path, 40);
  const std::string bytes = test::read_text(options_.path);
  test::write_text(options_.path, bytes.substr(0, bytes.size() * 2 / 3));
  const auto source = open_source(options_);
  EXPECT_GT(test::frames_before_error(*source, "the video is damaged"), 5);
}

// Overwrites a share of the file with zeros.
void zero(const std::string& path, double from, double to) {
  std::string bytes = test::read_text(path);
  const size_t begin = size_t(from * double(bytes.size())), end = size_t(to * double(bytes.size()));
  std::fill(bytes.begin() + long(begin), bytes.begin() + long(end), '\0');
  test::write_text(path, bytes);
}

// What a damaged video of `write_video` gives: frames that do not decode keep their numbers and times, and
// those after them theirs. At the ends of the damage, part of a frame may decode.
int check_bad_frames(ImageSource& source, int count) {
  int bad = 0, other = 0;
  for (int i = 0; i < count; ++i) try {
      const auto frame = source.next();
      EXPECT_TRUE(frame) << i;
      if (!frame) return -1;
      EXPECT_EQ(frame->index, i);
      other += std::abs(frame->image.pixels[100] - 5 * i) > 12;
    } catch (const BadFrame& e) {
      EXPECT_EQ(e.index(), i);
      EXPECT_EQ(e.time().ticks, i * 500000);
      EXPECT_THAT(e.what(),
                  ::testing::HasSubstr("frame " + std::to_string(i) + ": the image does not decode"));
      ++bad;
    }
  EXPECT_FALSE(source.next());
  EXPECT_LE(other, 2);
  return bad;
}

void write_slowly_brightening(const std::string& path, const char (&code)[5], int count) {
  cv::VideoWriter writer(path, cv::CAP_FFMPEG, cv::VideoWriter::fourcc(code[0], code[1], code[2], code[3]),
                         20, cv::Size(48, 32), true);
  ASSERT_TRUE(writer.isOpened());
  for (int i = 0; i < count; ++i) {
    cv::Mat frame(32, 48, CV_8UC3, cv::Scalar::all(5 * i));
    cv::randu(frame.rowRange(16, 32), 0, 256);
    writer.write(frame);
  }
}

// AVI: FFmpeg goes on with the next chunk and counts on as if there were no hole.
TEST_F(Video, FramesOfAHoleAreBadOnes) {
  write_slowly_brightening(options_.path, "FFV1", 40);
  zero(options_.path, 0.5, 0.55);
  EXPECT_GT(check_bad_frames(*open_source(options_), 40), 1);
  options_.every = 4;
  const auto thinned = open_source(options_);
  for (int i = 0; i < 20; i += 4) EXPECT_EQ(thinned->next()->index, i);
}

// MP4: OpenCV ends at the first packet that is not a frame.
TEST_F(Video, FramesAfterOneThatDoesNotDecodeAreRead) {
  options_.path = folder_ / "clip.mp4";
  write_slowly_brightening(options_.path, "mp4v", 40);
  zero(options_.path, 0.3, 0.45);
  EXPECT_GT(check_bad_frames(*open_source(options_), 40), 1);
}

// The last ones, too: a file that lists its frames is believed.
TEST_F(Video, TheLastFrameThatDoesNotDecodeIsABadOne) {
  options_.path = folder_ / "clip.mp4";
  write_slowly_brightening(options_.path, "mp4v", 40);
  std::string bytes = test::read_text(options_.path);
  const size_t moov = bytes.find("moov");
  std::fill(bytes.begin() + long(moov) - 40, bytes.begin() + long(moov) - 4, '\0');
  const size_t last = bytes.rfind(std::string("\0\0\1\xb6", 4), moov);
  ASSERT_NE(last, std::string::npos);
  std::fill(bytes.begin() + long(last), bytes.begin() + long(moov) - 4, '\0');
  test::write_text(options_.path, bytes);
  EXPECT_EQ(check_bad_frames(*open_source(options_), 40), 1);
}

// Sets the matrix of the track header, as a telephone does that is held upright or upside down.
void turn_container(const std::string& path, int quarter_turns) {
  std::string bytes = test::read_text(path);
  const size_t at = bytes.find("tkhd") + 4 + 40;
  ASSERT_LT(at + 36, bytes.size());
  const int32_t one = 65536, c[] = {one, 0, -one, 0}, s[] = {0, one, 0, -one};
  const int32_t matrix[] = {
      c[quarter_turns], s[quarter_turns], 0, -s[quarter_turns], c[quarter_turns], 0, 0, 0, 1 << 30};
  for (size_t i = 0; i < 9; ++i)
    for (size_t b = 0; b < 4; ++b) bytes[at + 4 * i + b] = char(uint32_t(matrix[i]) >> (24 - 8 * b));
  test::write_text(path, bytes);
}

// A video whose left half is dark, its top right quarter bright: where is what after turning?
void write_marked_video(const std::string& path, int quarter_turns) {
  cv::VideoWriter writer(path, cv::CAP_FFMPEG, cv::VideoWriter::fourcc('m', 'p', '4', 'v'), 20,
                         cv::Size(64, 32), true);
  ASSERT_TRUE(writer.isOpened());
  cv::Mat frame(32, 64, CV_8UC3, cv::Scalar::all(20));
  frame(cv::Rect(32, 0, 32, 16)).setTo(cv::Scalar::all(220));
  for (int i = 0; i < 5; ++i) writer.write(frame);
  writer.release();
  turn_container(path, quarter_turns);
}

// The principal point of the file is in the bright quarter: it must be there in the turned image, too.
TEST_F(Video, OfATurnedTelephoneHasATurnedCamera) {
  options_.path = folder_ / "clip.mp4";
  test::write_text(folder_ / "camera.txt", "60 58 34 14 0 0 0.001 0.002 64 32");
  for (int turns = 0; turns < 4; ++turns) {
    write_marked_video(options_.path, turns);
    const auto source = open_source(options_);
    const Pinhole p = source->camera().pinhole();
    const auto frame = source->next();
    ASSERT_TRUE(frame) << turns;
    EXPECT_EQ(frame->image.width, p.width);
    EXPECT_EQ(p.width, turns % 2 ? 32 : 64);
    EXPECT_EQ(p.fx, turns % 2 ? 58 : 60);
    const int at = int(p.cy) * p.width + int(p.cx), opposite = int(frame->image.pixels.size()) - 1 - at;
    EXPECT_GT(frame->image.pixels[size_t(at)], 150) << turns;
    EXPECT_LT(frame->image.pixels[size_t(opposite)], 80) << turns;
    const auto decisions = source->decisions();
    if (turns == 0) {
      EXPECT_TRUE(decisions.empty());
      continue;
    }
    ASSERT_EQ(decisions.size(), 2u);
    EXPECT_EQ(decisions[0].subject, "orientation");
    EXPECT_EQ(decisions[1].subject, "camera");
  }
}

// `info` and `run` agree: both refuse a camera file of another shape when the source is opened.
TEST_F(Video, RefusesACameraOfAnotherShapeOnOpening) {
  write_video(options_.path, 3);
  test::write_text(folder_ / "camera.txt", "40 40 16 24 0 0 0 0 32 48");
  EXPECT_THAT(test::error_of([&] { open_source(options_); }), ::testing::HasSubstr("the images are turned"));
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

// A hole in Matroska ends it, and the stamps before it may vary.
TEST_F(Video, OfVaryingRateThatEndsEarlyIsInDoubt) {
  write_video(options_.path, 40);
  options_.path = folder_ / "varying.mkv";
  test::write_varying_video(folder_ / "clip.avi", options_.path,
                            [](int i) { return i < 10 ? i : 3 * i - 20; });
  EXPECT_EQ(open_source(options_)->decisions().at(0).doubt, "");
  zero(options_.path, 0.6, 0.95);
  EXPECT_THAT(open_source(options_)->decisions().at(0).doubt,
              ::testing::HasSubstr("the video may be damaged"));
}

// A phone that drops to a third of its rate in bad light. OpenCV writes a constant rate only: two videos of
// different rates are joined as their packets, by FFmpeg's own library.
TEST_F(Video, AVaryingRateIsTakenFromTheStampsAndSaid) {
  write_video(options_.path, 30);
  options_.path = folder_ / "varying.mkv";
  test::write_varying_video(folder_ / "clip.avi", options_.path,
                            [](int i) { return i < 10 ? i : 3 * i - 20; });
  const auto source = open_source(options_);
  ASSERT_EQ(source->decisions().size(), 1u);
  EXPECT_EQ(to_string(source->decisions()[0]),
            "times: the video's own stamps (its rate varies from 6.7 to 20.0 frames a second)");
  const auto frames = test::read_all(*source);
  ASSERT_EQ(frames.size(), 30u);
  EXPECT_NEAR(frames[9].time.seconds(), 0.45, 1e-3);
  EXPECT_NEAR(frames[29].time.seconds(), (3 * 29 - 20) * 0.05, 1e-3);
  EXPECT_EQ(source->times().size(), 30u);
  options_.fps = 10;
  EXPECT_EQ(test::read_all(*open_source(options_))[29].time, Timestamp::from_seconds(2.9));
}

}  // namespace
}  // namespace edgevo
