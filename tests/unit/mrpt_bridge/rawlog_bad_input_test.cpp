// SPDX-License-Identifier: BSD-3-Clause
// Rawlogs that are truncated, damaged, or have unusable contents: reported in one line, after the good
// frames.
#include "unit/mrpt_bridge/rawlog_test_tools.h"

#include "edgevo/mrpt_bridge/rawlog_import.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using test::embedded;
using test::error_of;
using test::frames_before_error;
using test::TempFolder;
using ::testing::AllOf;
using ::testing::AnyOf;
using ::testing::HasSubstr;

TEST(BadRawlog, MissingOrEmpty) {
  TempFolder folder;
  EXPECT_THAT(error_of([&] { test::open(folder / "none.rawlog"); }),
              HasSubstr("none.rawlog: cannot be read: No such file"));
  test::write_text(folder / "empty.rawlog", "");
  EXPECT_THAT(error_of([&] { test::open(folder / "empty.rawlog"); }),
              HasSubstr("empty.rawlog: the file is empty (0 bytes)"));
  test::write_text(folder / "text.rawlog", "This is not a rawlog but a letter.");
  EXPECT_THAT(error_of([&] { test::open(folder / "text.rawlog"); }), HasSubstr("text.rawlog"));
}

// Wherever the file is cut, what is complete before the cut is returned and then the cut is reported; only
// the whole file ends without an error.
TEST(BadRawlog, CutShortAnywhere) {
  TempFolder folder;
  const std::string whole_path = folder / "whole.rawlog", path = folder / "cut.rawlog";
  test::write_embedded(whole_path, 6);
  const std::string bytes = test::read_text(whole_path);
  int fewest = 6, most = 0;
  for (size_t length = 60; length < bytes.size(); length += 37) {
    test::write_text(path, bytes.substr(0, length));
    int frames = 0;
    const std::string message = error_of([&] {
      const auto source = test::open(path);
      while (const auto frame = source->next()) {
        EXPECT_TRUE(test::same_pixels(frame->image, test::make_image(frames)));
        ++frames;
      }
    });
    EXPECT_THAT(message, HasSubstr("the file is cut short")) << length << " of " << bytes.size() << " bytes";
    fewest = std::min(fewest, frames);
    most = std::max(most, frames);
  }
  EXPECT_EQ(fewest, 0);
  EXPECT_GE(most, 5);
  EXPECT_EQ(test::read_all(*test::open(whole_path)).size(), 6u);
}

// Cut between two objects of an uncompressed stream, a file looks whole; inside an object it does not.
TEST(BadRawlog, UncompressedCutShort) {
  TempFolder folder;
  test::write_embedded(folder / "x.rawlog", 2);
  const std::string bytes = test::inflate(folder / "x.rawlog");
  test::write_text(folder / "cut.rawlog", bytes.substr(0, bytes.size() - 3));
  EXPECT_EQ(frames_before_error(*test::open(folder / "cut.rawlog"), "after 1 objects: the file is cut short"),
            1);
}

TEST(BadRawlog, DamagedDataAreReportedBeforeAnyFrame) {
  TempFolder folder;
  test::write_embedded(folder / "x.rawlog", 6);
  std::string bytes = test::read_text(folder / "x.rawlog");
  bytes[bytes.size() / 2] ^= 16;
  test::write_text(folder / "x.rawlog", bytes);
  EXPECT_THAT(error_of([&] { test::open(folder / "x.rawlog"); }),
              HasSubstr("its compressed data are damaged"));
}

TEST(BadRawlog, UnknownClassAfterGoodFrames) {
  TempFolder folder;
  test::write_embedded(folder / "x.rawlog", 3);
  const std::string bytes = test::inflate(folder / "x.rawlog");
  test::write_gz(folder / "y.rawlog", bytes + test::unknown_object() + bytes);
  EXPECT_EQ(frames_before_error(
                *test::open(folder / "y.rawlog"),
                "after 3 objects: an object of the unknown class 'ns::CObservationOfTomorrow' follows"),
            3);
  test::write_gz(folder / "z.rawlog", test::unknown_object() + bytes);
  EXPECT_THAT(
      error_of([&] { test::open(folder / "z.rawlog"); }),
      AllOf(HasSubstr("unknown class 'ns::CObservationOfTomorrow'"), HasSubstr("no image came before")));
}

TEST(BadRawlog, GarbageAfterGoodFrames) {
  TempFolder folder;
  test::write_embedded(folder / "x.rawlog", 2);
  test::write_gz(folder / "y.rawlog",
                 test::inflate(folder / "x.rawlog") + "garbage that goes on for a while and longer");
  EXPECT_EQ(frames_before_error(*test::open(folder / "y.rawlog"), "after 2 objects: "), 2);
}

TEST(BadRawlog, NoFolderOfImages) {
  TempFolder folder;
  RawlogWriter writer(folder / "x.rawlog");
  writer.write(test::external(0, "0.png"));
  writer.close();
  EXPECT_THAT(error_of([&] { test::open(folder / "x.rawlog"); }),
              HasSubstr("there is no folder " + (folder / "x_Images")));
}

TEST(BadRawlog, MissingImage) {
  TempFolder folder;
  fs::create_directories(folder / "x_Images");
  write_png(folder / "x_Images/0.png", test::make_image(0));
  RawlogWriter writer(folder / "x.rawlog");
  writer.write(test::external(0, "0.png"));
  writer.write(test::external(1, "1.png"));
  writer.close();
  EXPECT_EQ(frames_before_error(*test::open(folder / "x.rawlog"), "x_Images/1.png: the image is missing"), 1);
}

TEST(BadRawlog, FramesThatCannotBeUsed) {
  struct Case {
    const char* message;
    std::function<void(mrpt::obs::CObservationImage&)> spoil;
  };
  const Case cases[] = {
      {"frame 2 of CAM0: its time", [](auto& o) { o.timestamp = to_mrpt(test::frame_time(1)); }},
      {"frame 2 of CAM0: it has no time", [](auto& o) { o.timestamp = mrpt::Clock::time_point(); }},
      {"frame 2 of CAM0: the calibration differs", [](auto& o) { o.cameraParams.fx(99); }},
      {"frame 2 of CAM0: the image is 25x16",
       [](auto& o) { o.image = to_mrpt(test::make_image(2, 25, 16)); }},
      {"frame 2 of CAM0: the image is empty", [](auto& o) { o.image = mrpt::img::CImage(); }},
  };
  for (const Case& c : cases) {
    TempFolder folder;
    RawlogWriter writer(folder / "x.rawlog");
    for (int i = 0; i < 4; ++i) {
      auto o = embedded(i);
      if (i == 2) c.spoil(o);
      writer.write(o);
    }
    writer.close();
    EXPECT_EQ(frames_before_error(*test::open(folder / "x.rawlog"), c.message), 2);
  }
}

TEST(BadRawlog, NoCalibration) {
  TempFolder folder;
  RawlogWriter writer(folder / "x.rawlog");
  auto o = embedded(0);
  o.cameraParams = mrpt::img::TCamera();
  writer.write(o);
  writer.close();
  EXPECT_THAT(error_of([&] { test::open(folder / "x.rawlog"); }),
              HasSubstr("calibration of CAM0 (or give --camera)"));
  EXPECT_EQ(test::read_all(*open_rawlog({folder / "x.rawlog", "", test::small_camera()})).size(), 1u);
}

// /dev/full fails every write like a full disk.
TEST(BadRawlog, DiskFull) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "NOT TESTED: no /dev/full here";
  const std::string message = error_of([] {
    RawlogWriter writer("/dev/full");
    for (int i = 0; i < 50; ++i) writer.write(embedded(i));
    writer.close();
  });
  EXPECT_THAT(message, AllOf(HasSubstr("/dev/full: cannot be written: No space left on device"),
                             HasSubstr("free space")));
}

// A link to /dev/full acts as an image without room on the disk; the partial file is removed.
TEST(BadRawlog, ImageWithoutRoomLeavesNothing) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "NOT TESTED: no /dev/full here";
  TempFolder folder;
  fs::create_symlink("/dev/full", folder / "0.png");
  EXPECT_THAT(error_of([&] { write_png(folder / "0.png", test::make_image(0)); }),
              HasSubstr("No space left on device"));
  EXPECT_FALSE(fs::is_symlink(folder / "0.png"));
}

TEST(BadRawlog, OutputThatCannotBeOpened) {
  EXPECT_THAT(error_of([] { RawlogWriter("/nowhere/x.rawlog"); }),
              HasSubstr("/nowhere/x.rawlog: cannot be written: No such file"));
}

TEST(BadRawlog, BadTimesDoNotStopTheFollowingFrames) {
  TempFolder folder;
  RawlogWriter writer(folder / "x.rawlog");
  for (int i = 0; i < 12; ++i) {
    auto o = embedded(i);
    if (i == 3) o.timestamp = mrpt::Clock::time_point();
    if (i >= 6) o.timestamp -= std::chrono::seconds(30);  // the clock is set back
    writer.write(o);
  }
  writer.close();
  const auto source = test::open(folder / "x.rawlog");
  ASSERT_EQ(source->decisions().size(), 1u);
  EXPECT_EQ(source->decisions().front().value, "set back at frame 6");
  std::vector<int> good, bad;
  Timestamp last{-1};
  for (bool more = true; more;) try {
      const auto frame = source->next();
      more = frame.has_value();
      if (!more) break;
      EXPECT_LT(last, frame->time);
      last = frame->time;
      good.push_back(frame->index);
    } catch (const BadFrame& e) {
      EXPECT_EQ(e.what_is_bad(), BadFrame::What::kTime);
      bad.push_back(e.index());
    }
  EXPECT_EQ(bad, (std::vector<int>{3, 6, 7, 8}));
  EXPECT_EQ(good.size(), 8u);
  EXPECT_EQ(last, test::frame_time(11)) << "as if the clock had gone on";
}

}  // namespace
}  // namespace edgevo
