// SPDX-License-Identifier: BSD-3-Clause
// Which images of a folder are one sequence: never a zigzag through two cameras without a word.
#include "image_series.h"

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "transparency.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ImageSeries : public ::testing::Test {
 protected:
  void add(const std::string& pattern, int count) {
    for (int i = 0; i < count; ++i) {
      std::string name = pattern;
      name.replace(name.find('#'), 1, std::to_string(100 + i));
      test::write_text(folder_ / name, "");
    }
  }
  std::vector<std::string> names(const std::string& images = "") {
    SourceOptions options;
    options.images = images;
    decisions_.clear();
    std::vector<std::string> names;
    for (const std::string& path : list_images(folder_.path(), options, &decisions_))
      names.push_back(fs::path(path).filename().string());
    return names;
  }
  std::string refusal(const std::string& images = "") {
    return test::error_of([&] { names(images); });
  }
  test::TempFolder folder_;
  Decisions decisions_;
};

TEST_F(ImageSeries, NamesThatDifferInTheirNumbersAreOne) {
  EXPECT_EQ(pattern_of("left_000017.png"), "left_#.png");
  EXPECT_EQ(pattern_of("1305031102.175304.png"), "#.#.png");
  EXPECT_EQ(pattern_of("cam0_000017.png"), "cam0_#.png");
  EXPECT_EQ(pattern_of("000017_cam1.png"), "#_cam1.png");
  EXPECT_EQ(pattern_of("cam17.png"), "cam#.png");
  add("frame_#.png", 4);
  EXPECT_EQ(names().size(), 4u);
  EXPECT_TRUE(decisions_.empty());
}

TEST_F(ImageSeries, HexadecimalNumbersAreCounted) {
  for (int i = 0; i < 200; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "frame_%x.png", i);
    test::write_text(folder_ / name, "");
  }
  const std::vector<std::string> found = names();
  ASSERT_EQ(found.size(), 200u);
  EXPECT_EQ(found[10], "frame_a.png");
  EXPECT_EQ(found[16], "frame_10.png");
  EXPECT_EQ(found.back(), "frame_c7.png");
  ASSERT_EQ(decisions_.size(), 1u);
  EXPECT_THAT(decisions_[0].value, HasSubstr("hexadecimal"));
}

TEST_F(ImageSeries, HexadecimalNumbersThatAreThereTwiceAreNoOrder) {
  for (const char* number : {"a", "0a", "b1", "1", "c", "2d", "e", "3f"})
    test::write_text(folder_ / (std::string("x_") + number + ".png"), "");
  EXPECT_EQ(names().size(), 8u);
  EXPECT_THAT(decisions_.at(0).reason, HasSubstr("not of one pattern"));
}

TEST_F(ImageSeries, WordsOfHexadecimalLettersAreNoNumbers) {
  for (const char* word : {"bad", "face", "cafe", "dead", "beef", "fade", "add", "ace", "bee"})
    test::write_text(folder_ / (std::string(word) + ".png"), "");
  EXPECT_EQ(names().front(), "ace.png");
  EXPECT_THAT(decisions_.at(0).reason, HasSubstr("not of one pattern"));
  EXPECT_THAT(decisions_.at(0).doubt, HasSubstr("mixes up the path"));
}

TEST_F(ImageSeries, TwoCamerasAreRefusedUntilOneIsChosen) {
  add("#_left.png", 4);
  add("#_right.png", 4);
  EXPECT_THAT(
      refusal(),
      HasSubstr("the images are of several series: #_left.png (4), #_right.png (4); choose one, as with "
                "--images '#_left.png'"));
  EXPECT_THAT(names("#_right.png"),
              ElementsAre("100_right.png", "101_right.png", "102_right.png", "103_right.png"));
  EXPECT_EQ(names("*").size(), 8u);
  EXPECT_THAT(refusal("middle*"), HasSubstr("matches none of the images"));
}

TEST_F(ImageSeries, NumberedCamerasAreTwo) {
  add("cam0_#.png", 4);
  add("cam1_#.png", 4);
  EXPECT_THAT(refusal(), HasSubstr("cam0_#.png (4), cam1_#.png (4)"));
}

TEST_F(ImageSeries, MasksAndDepthsAreSkippedAndSaid) {
  add("#.png", 4);
  add("#_mask.png", 4);
  EXPECT_EQ(names().size(), 4u);
  ASSERT_EQ(decisions_.size(), 1u);
  EXPECT_EQ(to_string(decisions_[0]), "order: #.png (left out: #_mask.png (4))");
  add("depth_#.png", 4);
  EXPECT_THAT(names(), ElementsAre("100.png", "101.png", "102.png", "103.png"));
}

TEST_F(ImageSeries, AFewOddFilesAreSkippedWithAWarning) {
  add("IMG_#.jpg", 40);
  test::write_text(folder_ / "map.png", "");
  EXPECT_EQ(names().size(), 40u);
  EXPECT_EQ(decisions_.at(0).reason, "left out: map.png");
  EXPECT_THAT(decisions_.at(0).doubt, HasSubstr("--images '*' takes all"));
}

TEST_F(ImageSeries, ImagesOfTwoFormatsAreOneUnlessTheyAreTheSame) {
  add("#.png", 3);
  test::write_text(folder_ / "103.jpg", "");
  EXPECT_EQ(names().size(), 4u);
  add("#.jpg", 3);
  EXPECT_THAT(refusal(), HasSubstr("#.jpg (4), #.png (3)"));
}

TEST_F(ImageSeries, NamesWithoutAPatternAreTakenAsTheyAre) {
  for (const char* name : {"a.png", "b.png", "c.png"}) test::write_text(folder_ / std::string(name), "");
  EXPECT_EQ(names().size(), 3u);
  EXPECT_EQ(decisions_.at(0).reason, "the names are not of one pattern");
}

TEST_F(ImageSeries, APatternMatchesNumbersTextAndCharacters) {
  EXPECT_TRUE(matches("left_000017.png", "left_#.png"));
  EXPECT_FALSE(matches("left_.png", "left_#.png"));
  EXPECT_FALSE(matches("000017_mask.png", "#.png"));
  EXPECT_TRUE(matches("000017_mask.png", "*.png"));
  EXPECT_TRUE(matches("a1b", "a?b"));
  EXPECT_FALSE(matches("ab", "a?b"));
  EXPECT_TRUE(matches("", "*"));
}

TEST_F(ImageSeries, ImagesOneLevelDownAreNamed) {
  test::write_text(folder_ / "rgb/000001.webp", "");
  test::write_text(folder_ / "a/notes.txt", "");
  EXPECT_THAT(refusal(), HasSubstr("give the one below that does: " + (folder_ / "rgb")));
}

TEST_F(ImageSeries, TransparentPartsAreSaid) {
  const std::string path = folder_ / "000000.png";
  cv::Mat image(16, 24, CV_8UC4, cv::Scalar::all(255));
  cv::imwrite(path, image);
  EXPECT_FALSE(transparency_of({path})) << "of a channel that is opaque";
  image.rowRange(0, 4) = cv::Scalar(9, 9, 9, 0);
  cv::imwrite(path, image);
  const std::optional<InputDecision> said = transparency_of({path});
  ASSERT_TRUE(said);
  EXPECT_EQ(to_string(*said), "transparency: not read (25 % of the first image are transparent; --mask " +
                                  path + " takes no edges there)");
  EXPECT_FALSE(transparency_of({folder_ / "none.png"}));
  EXPECT_FALSE(transparency_of({}));
}

}  // namespace
}  // namespace edgevo
