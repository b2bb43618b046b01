// SPDX-License-Identifier: BSD-3-Clause
// The container: whole files by a strict reader, files cut off anywhere, times out of order.
#include "mcap_file.h"

#include <gmock/gmock.h>

#include "cdr.h"
#include "ros_schemas.h"
#include "strict_reader.h"
#include "support/temp_folder.h"

namespace edgevo {
namespace {

using test::read_strictly;
using ::testing::HasSubstr;

constexpr int64_t kSecond = Timestamp::kTicksPerSecond;

std::string bool_bytes() {
  CdrWriter out;
  out.add(true);
  return out.take();
}

// `count` messages on two channels, a tenth of a second apart, each second one before the one before it.
void write_file_of(int count, const std::string& path) {
  McapFile file(path, "a test");
  file.add_schema({"std_msgs/msg/Bool", ros_schema("std_msgs/msg/Bool")});
  const uint16_t a = file.add_channel({"/a", "std_msgs/msg/Bool", {{"offered_qos_profiles", ""}}});
  const uint16_t b = file.add_channel({"/b", "std_msgs/msg/Bool", {}});
  file.add_channel({"/never", "std_msgs/msg/Bool", {}});
  for (int i = 0; i < count; ++i)
    file.add_message(i % 3 == 0 ? b : a, {(i - (i % 2) * 5) * kSecond / 10 + kSecond}, bool_bytes());
  file.finish("a test", {{"a key", "a value"}});
}

TEST(McapFile, IsReadStrictly) {
  const test::TempFolder folder;
  write_file_of(100, folder.path() + "/x.mcap");
  const auto reading = read_strictly("check " + folder.path() + "/x.mcap");
  EXPECT_EQ(reading.code, 0) << reading.text;
  EXPECT_THAT(reading.text, HasSubstr("5 chunks, 100 messages"));
  EXPECT_THAT(reading.text, HasSubstr("34 /b std_msgs/msg/Bool"));
  EXPECT_THAT(reading.text, HasSubstr("{'a key': 'a value'}"));
}

TEST(McapFile, WithoutMessagesIsReadStrictly) {
  const test::TempFolder folder;
  write_file_of(0, folder.path() + "/x.mcap");
  const auto reading = read_strictly("check " + folder.path() + "/x.mcap");
  EXPECT_EQ(reading.code, 0) << reading.text;
}

TEST(McapFile, CutAnywhereHasTheChunksBefore) {
  const test::TempFolder folder;
  write_file_of(300, folder.path() + "/x.mcap");
  const auto reading = read_strictly("cut " + folder.path() + "/x.mcap 300");
  EXPECT_EQ(reading.code, 0) << reading.text;
}

// What a killed program leaves: no summary, but all chunks that have ended.
TEST(McapFile, GrowsByWholeChunks) {
  const test::TempFolder folder;
  const std::string path = folder.path() + "/x.mcap";
  McapFile file(path, "a test");
  file.add_schema({"std_msgs/msg/Bool", ros_schema("std_msgs/msg/Bool")});
  file.add_channel({"/a", "std_msgs/msg/Bool", {}});
  const auto before = std::filesystem::file_size(path);
  file.add_message(0, {kSecond}, bool_bytes());
  EXPECT_EQ(std::filesystem::file_size(path), before);
  file.add_message(0, {4 * kSecond}, bool_bytes());  // more than two seconds later
  EXPECT_GT(std::filesystem::file_size(path), before);
}

TEST(Cdr, AlignsNumbersAfterTheHead) {
  CdrWriter out;
  out.add(uint8_t(7));
  out.add(1.0);
  out.add("ab");
  out.add(uint16_t(0x102));
  out.add_bytes("xyz");
  const std::string want(
      "\0\1\0\0"
      "\7\0\0\0\0\0\0\0"
      "\0\0\0\0\0\0\xf0\x3f"
      "\3\0\0\0ab\0\0"
      "\2\1\0\0"
      "\3\0\0\0xyz",
      4 + 8 + 8 + 8 + 4 + 7);
  EXPECT_EQ(out.take(), want);
}

TEST(RosSchema, NamesNestedDefinitionsOnce) {
  const std::string text = ros_schema("nav_msgs/msg/Path"), line(80, '=');
  EXPECT_THAT(text, HasSubstr("geometry_msgs/PoseStamped[] poses\n" + line + "\nMSG: std_msgs/Header\n"));
  const std::string header = "MSG: std_msgs/Header\n";
  EXPECT_EQ(text.find(header), text.rfind(header));
  EXPECT_THROW(ros_schema("std_msgs/msg/Nothing"), std::out_of_range);
}

}  // namespace
}  // namespace edgevo
