// SPDX-License-Identifier: BSD-3-Clause
// --frames and --every.
#include "edgevo/datasets/open_source.h"
#include "unit/datasets/temp_sequence.h"

namespace edgevo {
namespace {

using test::error_of;
using test::read_all;
using ::testing::HasSubstr;

std::vector<int> indices(const std::string& path, const std::string& range, int every) {
  SourceOptions options;
  options.path = path;
  options.every = every;
  if (!range.empty()) set_frame_range(range, &options);
  const auto source = open_source(options);
  std::vector<int> result;
  for (const Frame& frame : read_all(*source)) {
    EXPECT_TRUE(test::same_pixels(frame.image, test::make_image(frame.index)));
    result.push_back(frame.index);
  }
  EXPECT_EQ(source->size(), int(result.size())) << range << " every " << every;
  EXPECT_EQ(source->times().size(), result.size());
  return result;
}

TEST(FrameRange, HalfOpenAndKeepsTheIndicesOfTheSource) {
  test::TempFolder folder;
  test::write_edgevo_layout(folder.path(), 8);
  using V = std::vector<int>;
  EXPECT_EQ(indices(folder.path(), "2:5", 1), (V{2, 3, 4}));
  EXPECT_EQ(indices(folder.path(), "2:", 3), (V{2, 5}));
  EXPECT_EQ(indices(folder.path(), ":3", 2), (V{0, 2}));
  EXPECT_EQ(indices(folder.path(), "", 4), (V{0, 4}));
  EXPECT_EQ(indices(folder.path(), "6:100", 1), (V{6, 7}));
  EXPECT_EQ(indices(folder.path(), "7:8", 9), (V{7}));
  EXPECT_EQ(indices(folder.path(), "", 1), (V{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(FrameRange, SkipsADamagedRangeWithoutReadingIt) {
  test::TempFolder folder;
  test::write_edgevo_layout(folder.path(), 6);
  for (int i = 0; i < 3; ++i)
    test::write_text(folder / ("images/00000" + std::to_string(i) + ".png"), "not an image");
  EXPECT_EQ(indices(folder.path(), "3:6", 1), (std::vector<int>{3, 4, 5}));
}

TEST(FrameRange, InvalidRangesAreReported) {
  SourceOptions o;
  EXPECT_THAT(error_of([&] { set_frame_range("5", &o); }), HasSubstr("--frames '5': is not A:B"));
  EXPECT_THAT(error_of([&] { set_frame_range(":", &o); }), HasSubstr("--frames ':': is not A:B"));
  EXPECT_THAT(error_of([&] { set_frame_range("5:5", &o); }), HasSubstr("holds no frame"));
  EXPECT_THAT(error_of([&] { set_frame_range("-1:5", &o); }), HasSubstr("not a frame number"));
  EXPECT_THAT(error_of([&] { set_frame_range("1.5:5", &o); }), HasSubstr("not a frame number"));
  EXPECT_THAT(error_of([&] { set_frame_range("a:b", &o); }), HasSubstr("'a' is not a number"));
  EXPECT_THAT(error_of([&] { set_frame_range("9:5", &o); }), HasSubstr("holds no frame"));
  EXPECT_THAT(error_of([&] { set_frame_range("1:2:3", &o); }), HasSubstr("--frames '1:2:3'"));
  EXPECT_THAT(error_of([&] { set_frame_range("0:99999999999", &o); }), HasSubstr("--frames '0:99999999999'"));
  test::TempFolder folder;
  test::write_edgevo_layout(folder.path(), 3);
  EXPECT_THAT(error_of([&] { indices(folder.path(), "3:5", 1); }), HasSubstr("begins at 3, but"));
  EXPECT_THAT(error_of([&] { indices(folder.path(), "", 0); }), HasSubstr("--every: is below 1"));
}

}  // namespace
}  // namespace edgevo
