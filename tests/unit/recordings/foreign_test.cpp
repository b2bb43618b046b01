// SPDX-License-Identifier: BSD-3-Clause
// Files that other programs wrote (foreign/README.md).
#include "edgevo/recordings/messages.h"

#include <gmock/gmock.h>

#include "edgevo/recordings/image_pixels.h"

namespace edgevo::test {
namespace {

using ::testing::IsEmpty;

class Foreign : public ::testing::TestWithParam<const char*> {};

TEST_P(Foreign, IsRead) {
  const std::string path = std::string(EDGEVO_SOURCE_DIR) + "/tests/unit/recordings/foreign/" + GetParam();
  const auto recording = open_recording(path);
  EXPECT_THAT(recording->missing(), IsEmpty());
  ASSERT_EQ(recording->topics().size(), 1u);
  const RecordedTopic& topic = recording->topics()[0];
  EXPECT_EQ(topic.name, "/cam/image_raw");
  EXPECT_EQ(topic.type, "sensor_msgs/Image");
  EXPECT_EQ(topic.messages, 3);
  recording->select({{0}});
  for (int i = 0; i < 3; ++i) {
    const auto message = recording->next();
    ASSERT_TRUE(message);
    const ImageMessage image = decode_image(message->bytes, topic.serialization, path);
    EXPECT_EQ(image.header.stamp.ticks, 16'000'000'000'000'000 + i * 500'000);
    EXPECT_EQ(message->recorded_ns, image.header.stamp.ticks * 100 + 1'000'000);
    EXPECT_EQ(image.header.frame, "cam");
    const GrayImage gray = gray_image(image, path);
    ASSERT_EQ(gray.pixels.size(), size_t(16 * 12));
    for (size_t k = 0; k < gray.pixels.size(); ++k) ASSERT_EQ(gray.pixels[k], uint8_t(7 * int(k) + 13 * i));
  }
  EXPECT_FALSE(recording->next());
}

INSTANTIATE_TEST_SUITE_P(Files, Foreign,
                         ::testing::Values("rosbag_none.bag", "rosbag_bz2.bag", "rosbag_lz4.bag",
                                           "mcap_plain.mcap", "mcap_zstd.mcap", "mcap_bare.mcap"));

}  // namespace
}  // namespace edgevo::test
