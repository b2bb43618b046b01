// SPDX-License-Identifier: BSD-3-Clause
// Broken input: one clear line (what, where, what to do), and the frames before it are delivered.
#include "edgevo/datasets/open_source.h"

#include <sys/stat.h>

#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using test::error_of;
using test::frames_before_error;
using test::read_text;
using test::TempFolder;
using test::write_text;
using ::testing::AllOf;
using ::testing::HasSubstr;

class BadFolder : public ::testing::Test {
 protected:
  BadFolder() { test::write_edgevo_layout(folder_.path(), 4); }
  std::unique_ptr<ImageSource> open() const {
    SourceOptions options;
    options.path = folder_.path();
    return open_source(options);
  }
  std::string open_error() const {
    return error_of([&] { open(); });
  }
  TempFolder folder_;
};

TEST(BadSource, MissingPath) {
  SourceOptions options;
  options.path = "/nowhere/at/all";
  EXPECT_EQ(error_of([&] { open_source(options); }),
            "/nowhere/at/all: no such file or folder; check the path");
}

TEST(BadSource, DeviceOrPipe) {
  const TempFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  for (const std::string& path : {std::string("/dev/zero"), folder / "pipe"}) {
    SourceOptions options;
    options.path = path;
    EXPECT_THAT(error_of([&] { open_source(options); }), HasSubstr("is a device or a pipe, not a file"));
  }
}

TEST(BadSource, EmptyFolder) {
  TempFolder folder;
  SourceOptions options;
  options.path = folder.path();
  EXPECT_THAT(error_of([&] { open_source(options); }),
              HasSubstr(folder.path() + ": the folder holds no images"));
}

TEST(BadSource, NeitherRawlogNorVideo) {
  TempFolder folder;
  std::string times;  // long enough for FFmpeg to draw its letters
  for (int i = 0; i < 300; ++i) times += std::to_string(i) + ".100000\n";
  write_text(folder / "letter.txt", "Dear camera");
  write_text(folder / "times.txt", times);
  for (const char* name : {"letter.txt", "times.txt"}) {
    SourceOptions options;
    options.path = folder / name;
    EXPECT_THAT(error_of([&] { open_source(options); }), HasSubstr("is neither a rawlog nor a video"));
  }
}

TEST(BadSource, FolderOfImagesWithoutCamera) {
  TempFolder folder;
  test::write_images(folder / "pictures", 1);
  SourceOptions options;
  options.path = folder / "pictures";
  EXPECT_THAT(error_of([&] { open_source(options); }),
              HasSubstr("no calibration; give the camera's file with --camera"));
}

TEST_F(BadFolder, NoImages) {
  fs::remove_all(folder_ / "images");
  fs::create_directories(folder_ / "images");
  EXPECT_THAT(open_error(), HasSubstr("/images: the folder holds no images"));
}

TEST_F(BadFolder, ImageThatIsNotAnImage) {
  write_text(folder_ / "images/000002.png", "this is text");
  const auto source = open();
  EXPECT_EQ(frames_before_error(*source, "000002.png: the image does not decode"), 2);
}

TEST_F(BadFolder, ABadImageDoesNotStopTheFollowingOnes) {
  write_text(folder_ / "images/000001.png", "this is text");
  fs::remove(folder_ / "images/000002.png");
  fs::create_symlink("/nowhere", folder_ / "images/000002.png");
  const auto source = open();
  EXPECT_EQ(source->next()->index, 0);
  EXPECT_THROW(source->next(), BadFrame);
  EXPECT_THROW(source->next(), BadFrame);
  EXPECT_EQ(source->next()->index, 3);
  EXPECT_FALSE(source->next());
}

TEST_F(BadFolder, ImageIsAPipe) {
  fs::remove(folder_ / "images/000002.png");
  ASSERT_EQ(mkfifo((folder_ / "images/000002.png").c_str(), 0600), 0);
  EXPECT_EQ(frames_before_error(*open(), "000002.png: the image is missing or cannot be read"), 2);
}

TEST_F(BadFolder, EmptyImage) {
  write_text(folder_ / "images/000001.png", "");
  EXPECT_EQ(frames_before_error(*open(), "000001.png: the image does not decode: the file is empty"), 1);
}

TEST_F(BadFolder, PngCutShort) {
  const std::string path = folder_ / "images/000003.png", bytes = read_text(path);
  for (const size_t length : {bytes.size() - 1, bytes.size() - 12, bytes.size() / 2, size_t(20)}) {
    write_text(path, bytes.substr(0, length));
    EXPECT_EQ(frames_before_error(*open(), "the file is cut short"), 3) << length << " bytes";
  }
}

TEST_F(BadFolder, PngWithAFlippedBit) {
  const std::string path = folder_ / "images/000003.png";
  std::string bytes = read_text(path);
  bytes[bytes.size() / 2] ^= 4;
  write_text(path, bytes);
  EXPECT_EQ(frames_before_error(*open(), "checksum"), 3);
}

TEST_F(BadFolder, ImageIsAFolder) {
  fs::remove(folder_ / "images/000002.png");
  fs::create_directories(folder_ / "images/000002.png");
  EXPECT_EQ(frames_before_error(*open(), "000002.png: the image"), 2);
}

TEST_F(BadFolder, SizeThatDiffersFromTheCamera) {
  write_png(folder_ / "images/000001.png", test::make_image(1, 25, 16));
  EXPECT_EQ(frames_before_error(*open(), "the image is 25x16, but the camera model is for 24x16"), 1);
}

TEST_F(BadFolder, TimesThatDoNotIncrease) {
  write_text(folder_ / "times.txt", "0\n0.1\n0.1\n0.3\n");
  EXPECT_EQ(frames_before_error(*open(), "(frame 2): its time 0.1000000 s is not after the frame before"), 2);
  write_text(folder_ / "times.txt", "0\n0.1\n0.2\n0.15\n");
  EXPECT_EQ(frames_before_error(*open(), "(frame 3): its time 0.1500000 s"), 3);
  write_text(folder_ / "times.txt", "0\n0.1\n-\n0.3\n");
  EXPECT_EQ(frames_before_error(*open(), "(frame 2): it has no time"), 2);
}

TEST_F(BadFolder, ABadTimeDoesNotStopTheFollowingFrames) {
  write_text(folder_ / "times.txt", "0\n0.1\n0.1\n0.3\n");
  const auto source = open();
  EXPECT_EQ(frames_before_error(*source, "is not after"), 2);
  const auto last = source->next();
  ASSERT_TRUE(last);
  EXPECT_EQ(last->index, 3);
  EXPECT_FALSE(source->next());
}

TEST_F(BadFolder, CountsThatDiffer) {
  write_text(folder_ / "times.txt", "0\n0.1\n0.2\n");
  EXPECT_THAT(open_error(),
              AllOf(HasSubstr("times.txt: 3 times for 4 images"), HasSubstr("one time for each image")));
}

TEST_F(BadFolder, TimesInTwoUnits) {
  write_text(folder_ / "times.txt", "0\n0.1\n200000000\n300000000\n");
  EXPECT_THAT(open_error(),
              AllOf(HasSubstr("times.txt, line 3: '200000000' is in another unit than '0.1' before it"),
                    HasSubstr("a factor of 1000000000"), HasSubstr("all times in seconds")));
}

TEST_F(BadFolder, TimesInAFinerUnit) {
  write_text(folder_ / "times.txt", "0\n33\n67\n100\n");
  const auto source = open();
  EXPECT_EQ(source->times()[3], Timestamp::from_seconds(0.1));
  ASSERT_EQ(source->decisions().size(), 1u);
  EXPECT_EQ(to_string(source->decisions()[0]), "times: in milliseconds (33 ms from image to image)");
}

TEST_F(BadFolder, AByteOrderMarkIsNoPartOfTheFirstNumber) {
  for (const char* name : {"times.txt", "camera.txt"})
    write_text(folder_ / std::string(name), "\xEF\xBB\xBF" + read_text(folder_ / std::string(name)));
  EXPECT_EQ(test::read_all(*open()).size(), 4u);
}

TEST_F(BadFolder, Utf16IsNamed) {
  for (const char* name : {"times.txt", "camera.txt"}) {
    const std::string text = read_text(folder_ / name);
    std::string wide = "\xFF\xFE";
    for (const char c : text) wide += {c, '\0'};
    write_text(folder_ / name, wide);
    EXPECT_THAT(open_error(),
                HasSubstr(std::string(name) + ": the text is UTF-16, which is not read; save it as UTF-8"));
    write_text(folder_ / name, text);
  }
}

TEST_F(BadFolder, HiddenFilesAreNoImages) {
  for (const char* name : {"._000000.png", ".000001.png", "Thumbs.db", ".DS_Store"})
    write_text(folder_ / (std::string("images/") + name), std::string("\0\5\26\7Mac OS X", 12));
  EXPECT_EQ(test::read_all(*open()).size(), 4u);
}

TEST_F(BadFolder, InvalidTime) {
  write_text(folder_ / "times.txt", "0\n0.1\nnoon\n0.3\n");
  EXPECT_THAT(open_error(), HasSubstr("times.txt, line 3: 'noon' is not a time"));
}

TEST_F(BadFolder, MissingTimesOrCamera) {
  fs::remove(folder_ / "camera.txt");
  EXPECT_THAT(open_error(), AllOf(HasSubstr("camera.txt is missing"), HasSubstr("--camera")));
  fs::remove(folder_ / "times.txt");
  EXPECT_THAT(open_error(), HasSubstr("times.txt: is missing"));
}

TEST_F(BadFolder, LabelForASourceWithoutLabels) {
  SourceOptions options;
  options.path = folder_.path();
  options.sensor_label = "CAM7";
  EXPECT_THAT(error_of([&] { open_source(options); }), HasSubstr("no sensor 'CAM7'"));
}

}  // namespace
}  // namespace edgevo
