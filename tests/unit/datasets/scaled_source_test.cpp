// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/datasets/scaled_source.h"

#include "edgevo/datasets/open_source.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

using test::TempFolder;

// A black image whose right half from `edge` on is white, and a camera that looks at that edge's middle.
class ScaledImages : public ::testing::Test {
 protected:
  ScaledImages() {
    GrayImage image{80, 40, std::vector<uint8_t>(80 * 40)};
    for (int y = 0; y < 40; ++y)
      for (int x = kEdge; x < 80; ++x) image.pixels[size_t(80 * y + x)] = 200;
    std::filesystem::create_directories(folder_ / "images");
    for (const char* name : {"images/0.png", "images/1.png"}) write_png(folder_ / name, image);
    test::write_text(folder_ / "camera.txt",
                     "60 50 " + std::to_string(kEdge - 0.5) + " 19.5 0.1 0 0 0 80 40");
    options_.path = folder_ / "images";
    options_.camera_file = folder_ / "camera.txt";
  }
  static constexpr int kEdge = 32;
  TempFolder folder_;
  SourceOptions options_;
};

TEST_F(ScaledImages, AgreeWithTheirCamera) {
  options_.image_scale = 0.5;
  const auto source = open_source(options_);
  const Camera camera = source->camera();
  EXPECT_EQ(camera.pinhole().width, 40);
  EXPECT_EQ(camera.pinhole().height, 20);
  EXPECT_DOUBLE_EQ(camera.pinhole().fx, 30);
  EXPECT_DOUBLE_EQ(camera.pinhole().fy, 25);
  EXPECT_DOUBLE_EQ(camera.distortion().k1, 0.1);
  const auto frames = test::read_all(*source);
  ASSERT_EQ(frames.size(), 2u);
  const GrayImage& image = frames[1].image;
  ASSERT_EQ(image.width, 40);
  // The edge lies between the pixels on both sides of the centre, as before.
  EXPECT_DOUBLE_EQ(camera.pinhole().cx, 15.5);
  EXPECT_EQ(image.view().at(15, 10), 0);
  EXPECT_EQ(image.view().at(16, 10), 200);
  EXPECT_TRUE(frames[1].image_path.empty());  // no file holds this image
  EXPECT_EQ(frames[1].index, 1);
}

TEST_F(ScaledImages, KeepTheirDepth) {
  std::string pgm = "P5 80 40 65535\n";
  for (int i = 0; i < 80 * 40; ++i) pgm += i % 80 < kEdge ? std::string(2, '\0') : std::string("\x32\x01");
  std::filesystem::create_directories(folder_ / "deep");
  for (const char* name : {"deep/0.pgm", "deep/1.pgm"}) test::write_text(folder_ / name, pgm);
  options_.path = folder_ / "deep";
  options_.image_scale = 0.5;
  const GrayImage image = open_source(options_)->next()->image;
  ASSERT_EQ(image.values.size(), 40u * 20u);
  EXPECT_EQ(image.values[10 * 40 + 15], 0);
  EXPECT_EQ(image.values[10 * 40 + 16], 0x3201);
  EXPECT_EQ(image.scale.per_level, 64) << "14 bits";
  EXPECT_EQ(image.view().at(16, 10), 200);
}

TEST_F(ScaledImages, AreReportedWithTheirSizes) {
  options_.image_scale = 0.5;
  const auto source = open_source(options_);
  EXPECT_THAT(source->details(), ::testing::Contains(::testing::Pair(kScaled, "from 80x40 to 40x20")));
  EXPECT_EQ(source->size(), 2);
  EXPECT_TRUE(source->skip());
  EXPECT_EQ(source->next()->index, 1);
  EXPECT_FALSE(source->next());
}

TEST_F(ScaledImages, OnlyWhereTheyAreLarge) {
  EXPECT_EQ(usual_image_scale(640, 480), 1);
  EXPECT_EQ(usual_image_scale(1241, 376), 1);
  EXPECT_EQ(usual_image_scale(1344, 391), 1);
  EXPECT_EQ(usual_image_scale(364, 674), 1);
  options_.image_scale = kAutomaticScale;
  EXPECT_EQ(open_source(options_)->camera().pinhole().width, 80);
}

TEST_F(ScaledImages, LargeOnesHaveTheSameNumberOfPixelsWhateverTheirShape) {
  for (const auto& [width, height] : {std::pair{1280, 720}, {1920, 1080}, {720, 1280}, {3840, 2160}}) {
    const double scale = usual_image_scale(width, height);
    EXPECT_NEAR(scale * width * scale * height, 480000, 1) << width;
  }
  EXPECT_DOUBLE_EQ(usual_image_scale(2560, 200) * 2560, 1241) << "few pixels, but too wide";
}

TEST_F(ScaledImages, SayWhyTheyWereScaledUnasked) {
  const GrayImage image{1280, 720, std::vector<uint8_t>(1280 * 720)};
  for (const char* name : {"images/0.png", "images/1.png"}) write_png(folder_ / name, image);
  test::write_text(folder_ / "camera.txt", "760 760 639.5 359.5 0 0 0 0 1280 720");
  options_.image_scale = kAutomaticScale;
  const auto source = open_source(options_);
  EXPECT_THAT(source->details(),
              ::testing::Contains(::testing::Pair(
                  kScaled, ::testing::StartsWith("from 1280x720 to 924x520: they cost half the time"))));
}

TEST_F(ScaledImages, RefuseATooSmallScale) {
  for (const double scale : {0.005, 1.5, -1.0, 0.1}) {
    options_.image_scale = scale;
    EXPECT_THROW(open_source(options_), InputError) << scale;
  }
}

}  // namespace
}  // namespace edgevo
