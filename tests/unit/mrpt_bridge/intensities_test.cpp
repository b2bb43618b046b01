// SPDX-License-Identifier: BSD-3-Clause
// Images of more than 8 bits give the gray levels that the same scene gives in 8.
#include "edgevo/mrpt_bridge/intensities.h"

#include <opencv2/imgcodecs.hpp>

#include "unit/mrpt_bridge/rawlog_test_tools.h"

namespace edgevo {
namespace {

using ::testing::HasSubstr;

constexpr int kSide = 64;

// A scene of all gray levels, as a camera of other values shows it.
DeepImage deep_scene(double gain, double offset = 0) {
  DeepImage image{kSide, kSide, {}};
  for (int i = 0; i < kSide * kSide; ++i) image.values.push_back(uint16_t(offset + gain * ((i * 37) % 256)));
  return image;
}

uint8_t gray_at(int i) { return uint8_t((i * 37) % 256); }

// Largest difference in gray levels from the scene in 8 bits.
int difference(const GrayImage& image) {
  int largest = 0;
  for (int i = 0; i < kSide * kSide; ++i)
    largest = std::max(largest, std::abs(int(image.pixels[size_t(i)]) - gray_at(i)));
  return largest;
}

TEST(Intensities, EveryUsualDepthGivesTheSameGrayLevels) {
  for (const auto& [gain, name] : {std::pair(1., "8 bits in 16-bit images"),
                                   {4., "10 bits in 16-bit images"},
                                   {16., "12 bits in 16-bit images"},
                                   {64., "14 bits in 16-bit images"},
                                   {256., "16 bits"}}) {
    const DeepImage image = deep_scene(gain);
    const Intensities found = decide_intensities(image);
    EXPECT_EQ(found.decision->value, name);
    EXPECT_EQ(difference(with_pixels(image, *found.scale)), 0) << name;
  }
  EXPECT_EQ(decide_intensities(deep_scene(16)).decision->reason, "the largest value of the image is 4,080");
}

TEST(Intensities, ANarrowBandFarFromZeroIsSpreadOut) {
  const DeepImage image = deep_scene(8, 29000);
  const Intensities found = decide_intensities(image);
  EXPECT_EQ(found.decision->value, "values 28,745 to 31,295 as black to white");
  const GrayImage gray = with_pixels(image, *found.scale);
  const auto [low, high] = std::minmax_element(gray.pixels.begin(), gray.pixels.end());
  EXPECT_GT(*high - *low, 200);
}

TEST(Intensities, ValuesBeyondTheScalingAreBlackOrWhite) {
  const IntensityScale scale{28745, 10};
  const DeepImage image{4, 1, {0, 28744, 31300, 65535}};
  EXPECT_EQ(with_pixels(image, scale).pixels, (std::vector<uint8_t>{0, 0, 255, 255}));
}

TEST(Intensities, TheValuesStayWithThePixels) {
  const DeepImage image = deep_scene(16);
  const GrayImage gray = with_pixels(image, {0, 16});
  EXPECT_EQ(gray.values, image.values);
  EXPECT_EQ(gray.scale.per_level, 16);
  EXPECT_TRUE(gray.is_deep());
}

TEST(Intensities, TwelveBitsInTheUpperOnesAreRecognisedInADarkScene) {
  DeepImage image = deep_scene(1);
  for (uint16_t& value : image.values) value = uint16_t(16 * int(value * 3.9));  // up to 15,904 of 65,520
  const Intensities found = decide_intensities(image);
  EXPECT_EQ(found.decision->value, "12 bits in the upper ones of 16");
  EXPECT_EQ(found.scale->per_level, 256);
}

TEST(Intensities, ADarkBeginningDoesNotDecide) {
  const test::TempFolder folder;
  std::vector<std::string> paths;
  for (int i = 0; i < 40; ++i) {
    DeepImage image = deep_scene(i < 20 ? 0.5 : 16);
    paths.push_back(folder / (std::to_string(i) + ".png"));
    cv::imwrite(paths.back(), cv::Mat(kSide, kSide, CV_16UC1, image.values.data()));
  }
  const Intensities found = decide_intensities(paths, 0);
  EXPECT_EQ(
      to_string(*found.decision),
      "intensities: 12 bits in 16-bit images (the largest value of 10 images of the sequence is 4,080)");
  EXPECT_EQ(difference(read_gray_image(paths[30], found.scale)), 0);
}

TEST(Intensities, BitsAreForced) {
  IntensityCount count;
  count.add(deep_scene(4));
  EXPECT_EQ(decide_intensities(count, 12, "").scale->per_level, 16);
  EXPECT_THROW(decide_intensities(count, 17, ""), InputError);
  EXPECT_THAT(test::error_of([] { decide_intensities(IntensityCount(), 12, ""); }),
              HasSubstr("the images have 8 bits"));
}

TEST(Intensities, BlackImagesAreADoubt) {
  EXPECT_THAT(decide_intensities(DeepImage{2, 2, {0, 0, 0, 0}}).decision->doubt, HasSubstr("give --bits"));
}

// In a folder, as external images and inside a rawlog, the same image gives the same pixels.
TEST(Intensities, ARawlogGivesThePixelsOfTheFiles) {
  const test::TempFolder folder;
  std::filesystem::create_directories(folder / "external_Images");
  RawlogWriter inside(folder / "inside.rawlog"), external(folder / "external.rawlog");
  for (int i = 0; i < 3; ++i) {
    cv::Mat deep;
    const GrayImage gray = test::make_image(i);
    cv::Mat(16, 24, CV_8UC1, const_cast<uint8_t*>(gray.pixels.data())).convertTo(deep, CV_16U, 16);
    cv::imwrite(folder / ("external_Images/" + std::to_string(i) + ".png"), deep);
    auto observation = test::embedded(i);
    observation.image = mrpt::img::CImage(deep, mrpt::img::DEEP_COPY);
    inside.write(observation);
    external.write(test::external(i, std::to_string(i) + ".png"));
  }
  inside.close();
  external.close();
  for (const char* name : {"inside.rawlog", "external.rawlog"}) {
    const auto source = test::open(folder / std::string(name));
    EXPECT_EQ(source->decisions().at(0).value, "12 bits in 16-bit images") << name;
    const auto frames = test::read_all(*source);
    ASSERT_EQ(frames.size(), 3u);
    for (int i = 0; i < 3; ++i)
      EXPECT_TRUE(test::same_pixels(frames[size_t(i)].image, test::make_image(i))) << name;
    EXPECT_EQ(frames[0].image_path, "") << "the file does not hold these pixels";
  }
}

// `edgevo info --check` reads every image.
TEST(Intensities, AnotherDepthLaterIsReported) {
  const test::TempFolder folder;
  test::write_edgevo_layout(folder.path(), 4);
  cv::imwrite(folder / "images/000002.png", cv::Mat(16, 24, CV_16UC1, cv::Scalar(1000)));
  EXPECT_THAT(test::error_of([&] { read_gray_image(folder / "images/000002.png", std::nullopt); }),
              HasSubstr("the image has 16 bits, but the first images have 8; convert all to the same depth"));
  EXPECT_THAT(test::error_of([&] { read_gray_image(folder / "images/000001.png", IntensityScale()); }),
              HasSubstr("the image has 8 bits, but the first images have 16"));
}

}  // namespace
}  // namespace edgevo
