// SPDX-License-Identifier: BSD-3-Clause
#include "wrapped_order.h"

#include "edgevo/datasets/open_source.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(WrappedOrder, NumbersBeginAgainWhereTheHalvesFollowEachOther) {
  EXPECT_EQ(begin_before_wrap({1, 2, 3, 9998, 9999}, 10000), 3u);
  EXPECT_EQ(begin_before_wrap({0, 1, 9999}, 10000), 2u);
  for (const std::vector<double>& numbers : std::vector<std::vector<double>>{
           {1, 2, 3, 4, 9000}, {1, 2, 3, 900, 901}, {50, 51, 9998, 9999}, {1, 2, 3}, {1, 9999}, {}})
    EXPECT_FALSE(begin_before_wrap(numbers, 10000));
}

// A ramp that moves by a step an image: images in a row are alike.
GrayImage moving_ramp(int step) {
  GrayImage image{64, 48, {}};
  for (int i = 0; i < 64 * 48; ++i) image.pixels.push_back(uint8_t((i % 64 + 4 * step) % 256));
  return image;
}

class FolderOrder : public ::testing::Test {
 protected:
  // The sequence of the images with these names, image i with step i.
  std::unique_ptr<ImageSource> open(const std::vector<std::string>& names) {
    folder_.emplace();
    for (size_t i = 0; i < names.size(); ++i) write_png(*folder_ / (names[i] + ".png"), moving_ramp(int(i)));
    SourceOptions options;
    options.path = folder_->path();
    options.fov_deg = 60;
    return open_source(options);
  }

  static std::vector<int> order_of(ImageSource& source) {
    std::vector<int> first_pixels;
    while (const auto frame = source.next()) first_pixels.push_back(frame->image.pixels[0] / 4);
    return first_pixels;
  }

  static std::string order_decision(const ImageSource& source) {
    for (const InputDecision& d : source.decisions())
      if (d.subject == "order") return to_string(d);
    return {};
  }

  std::optional<test::TempFolder> folder_;
};

TEST_F(FolderOrder, NumbersAreComparedAsNumbers) {
  const auto source = open({"1700000000.88", "1700000000.984", "1700000001.088", "1700000001.1"});
  EXPECT_THAT(order_of(*source), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(order_decision(*source), HasSubstr("by the times in the names"));
}

TEST_F(FolderOrder, AClockPassesMidnight) {
  const auto source = open({"235959_800", "235959_900", "000000_000", "000000_100"});
  EXPECT_THAT(order_of(*source), ElementsAre(0, 1, 2, 3));
  const std::vector<Timestamp> times = source->times();
  EXPECT_NEAR(seconds_between(times.front(), times.back()), 0.3, 1e-9);
  EXPECT_THAT(order_decision(*source), HasSubstr("from 235959_800.png, and on with 000000_000.png"));
}

TEST_F(FolderOrder, SummerTimeEnds) {
  const auto source = open({"2026-10-25_02-59-59.800", "2026-10-25_02-59-59.900", "2026-10-25_02-00-00.000",
                            "2026-10-25_02-00-00.100"});
  EXPECT_THAT(order_of(*source), ElementsAre(0, 1, 2, 3));
}

TEST_F(FolderOrder, ACounterBeginsAgainOnlyIfTheImagesSaySo) {
  const auto wrapped = open({"IMG_9997", "IMG_9998", "IMG_9999", "IMG_0001", "IMG_0002"});
  EXPECT_THAT(order_of(*wrapped), ElementsAre(0, 1, 2, 3, 4));
  const auto zero_before = open({"DSC09997", "DSC09998", "DSC09999", "DSC00001", "DSC00002"});
  EXPECT_THAT(order_of(*zero_before), ElementsAre(0, 1, 2, 3, 4));
  const auto gap = open({"IMG_0001", "IMG_0002", "IMG_9997", "IMG_9998", "IMG_9999"});
  EXPECT_THAT(order_of(*gap), ElementsAre(0, 1, 2, 3, 4));
}

}  // namespace
}  // namespace edgevo
