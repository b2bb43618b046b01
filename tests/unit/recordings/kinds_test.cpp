// SPDX-License-Identifier: BSD-3-Clause
// Every kind of file gives the messages that were written, whole and in pieces.
#include <gmock/gmock.h>

#include "edgevo/core/random.h"
#include "made_recording.h"

namespace edgevo::test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Kinds, GiveWhatWasWritten) {
  for (const RecordingKind& kind : recording_kinds()) {
    SCOPED_TRACE(kind.name);
    const TempFolder folder;
    const MadeRecording made = made_recording(kind.wire);
    const auto recording = open_recording(kind.write(folder, made));
    ASSERT_EQ(recording->topics().size(), 3u);
    EXPECT_THAT(recording->missing(), IsEmpty());
    for (size_t i = 0; i < made.topics.size(); ++i) {
      const auto expected = written(made, i);
      EXPECT_EQ(read_all(recording.get(), made.topics[i].name), expected);
      const RecordedTopic& topic = recording->topics()[topic_named(*recording, made.topics[i].name)];
      EXPECT_EQ(topic.type, made.topics[i].type);
      const bool is_counted = kind.name != "mcap without any index";
      EXPECT_EQ(topic.messages.value_or(-1), is_counted ? int64_t(expected.size()) : -1);
      EXPECT_EQ(topic.serialization, kind.wire == Wire::kRos1 ? Serialization::kRos1 : Serialization::kCdr);
    }
  }
}

TEST(Kinds, ReadHeadsAlone) {
  for (const RecordingKind& kind : recording_kinds()) {
    SCOPED_TRACE(kind.name);
    const TempFolder folder;
    const MadeRecording made = made_recording(kind.wire);
    const auto recording = open_recording(kind.write(folder, made));
    auto expected = written(made, 1);
    for (auto& [time, bytes] : expected) bytes.resize(40);
    EXPECT_EQ(read_all(recording.get(), made.topics[1].name, 40), expected);
  }
}

TEST(Kinds, AreRecognised) {
  const TempFolder folder;
  EXPECT_TRUE(is_recording("x.bag"));
  EXPECT_TRUE(is_recording("x.mcap.zstd"));
  EXPECT_FALSE(is_recording("x.rawlog"));
  EXPECT_FALSE(is_recording(folder.path()));
  folder.write("metadata.yaml", "title: a folder of images\n");
  EXPECT_FALSE(is_recording(folder.path()));
  folder.write("y.db3", "");
  EXPECT_TRUE(is_recording(folder.path()));
}

// What is read of a file that ends at `size` bytes: the first messages, each whole.
void expect_beginning(const std::string& path, const MadeRecording& made, int* opened) {
  try {
    const auto recording = open_recording(path);
    const auto expected = written(made, 1);
    ++*opened;
    EXPECT_THAT(recording->missing(), AnyOf(HasSubstr("cut off"), HasSubstr("not closed")));
    EXPECT_EQ(recording->missing().find('\n'), std::string::npos);
    if (topic_named(*recording, made.topics[1].name) == SIZE_MAX) return;
    const auto read = read_all(recording.get(), made.topics[1].name);
    ASSERT_LE(read.size(), expected.size());
    EXPECT_TRUE(std::equal(read.begin(), read.end(), expected.begin()));
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
  }
}

TEST(Kinds, OfAnyLengthGiveTheirBeginning) {
  constexpr int kCuts = 100;
  for (const RecordingKind& kind : recording_kinds()) {
    if (kind.name.find("folder") != std::string::npos || kind.name.find("zstd ") != std::string::npos)
      continue;
    SCOPED_TRACE(kind.name);
    const TempFolder folder;
    const MadeRecording made = made_recording(kind.wire, 60);
    const std::string path = kind.write(folder, made), whole = content(path);
    Random random(5);
    int opened = 0;
    for (int i = 0; i < kCuts; ++i) {
      const size_t size = size_t(random.below(int(whole.size())));
      SCOPED_TRACE(size);
      std::ofstream(path, std::ios::binary) << whole.substr(0, size);
      expect_beginning(path, made, &opened);
    }
    EXPECT_GT(opened, kCuts / 2);
  }
}

TEST(Kinds, WithoutTheLastBytesAllWholeChunksAreRead) {
  for (const RecordingKind& kind : recording_kinds()) {
    if (kind.name.find("db3") != std::string::npos || kind.name.find("folder") != std::string::npos) continue;
    SCOPED_TRACE(kind.name);
    const TempFolder folder;
    const MadeRecording made = made_recording(kind.wire);
    const std::string path = kind.write(folder, made), whole = content(path);
    std::ofstream(path, std::ios::binary) << whole.substr(0, whole.size() - 4);
    const auto recording = open_recording(path);
    EXPECT_EQ(read_all(recording.get(), made.topics[1].name), written(made, 1));
  }
}

TEST(Kinds, OtherFilesAreRefused) {
  const TempFolder folder;
  const auto message = [&](const std::string& name, const std::string& bytes) {
    try {
      open_recording(write_bytes(folder, name, bytes));
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  for (const char* name : {"x.bag", "x.mcap", "x.db3"}) {
    EXPECT_THAT(message(name, ""), HasSubstr("is empty"));
    EXPECT_THAT(message(name, "something else that is long enough"), HasSubstr("is not a"));
  }
  EXPECT_THAT(message("x.bag", "#ROSBAG V1.2\n"), HasSubstr("version 1.2, which is not read"));
  EXPECT_THAT(message("x.mcap.zstd", "no"), HasSubstr("is not a Zstandard file"));
  EXPECT_THROW(open_recording(folder / "none.bag"), InputError);
}

}  // namespace
}  // namespace edgevo::test
