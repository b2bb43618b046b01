// SPDX-License-Identifier: BSD-3-Clause
// Damage within files, and recordings that were not closed.
#include <gmock/gmock.h>

#include "made_recording.h"

namespace edgevo::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string missing(const std::string& path) { return open_recording(path)->missing(); }

// Reads the images; every entry but those of damaged parts must be as it was written.
int damaged_parts(Recording* recording, const MadeRecording& made, const std::string& what) {
  const auto expected = written(made, 1);
  int damaged = 0;
  for (const auto& message : read_all(recording, made.topics[1].name)) {
    if (message.first == 0) {
      ++damaged;
      EXPECT_THAT(message.second, HasSubstr(what));
    } else {
      EXPECT_EQ(std::count(expected.begin(), expected.end(), message), 1);
    }
  }
  return damaged;
}

// A byte in the data of the second chunk.
size_t place_in_second_chunk(const std::string& bytes, const std::string& compression) {
  const std::string name = with_length(compression);
  constexpr size_t kBehindHead = 40;
  if (compression.empty()) return bytes.size() / 3;
  return bytes.find(name, bytes.find(name) + 1) + name.size() + kBehindHead;
}

TEST(Damage, AWrongChecksumCostsItsChunk) {
  for (const char* compression : {"", "lz4", "zstd"}) {
    const TempFolder folder;
    const MadeRecording made = made_recording(Wire::kCdrLittle);
    std::string bytes = mcap_file(made.topics, made.messages, mcap_options(compression));
    const size_t at = place_in_second_chunk(bytes, compression);
    bytes[at] = char(bytes[at] ^ 1);
    const auto recording = open_recording(write_bytes(folder, "x.mcap", bytes));
    EXPECT_EQ(damaged_parts(recording.get(), made, "chunk at byte"), 1) << compression;
    EXPECT_GE(read_all(recording.get(), made.topics[1].name).size(), size_t(kMadeImages) - 3);
  }
}

TEST(Damage, ADamagedSummaryIsNotBelieved) {
  const TempFolder folder;
  const MadeRecording made = made_recording(Wire::kCdrLittle);
  std::string bytes = mcap_file(made.topics, made.messages, mcap_options("zstd"));
  const size_t at = bytes.size() - 60;
  bytes[at] = char(bytes[at] ^ 1);
  const auto recording = open_recording(write_bytes(folder, "x.mcap", bytes));
  EXPECT_THAT(recording->missing(), HasSubstr("summary is damaged"));
  EXPECT_EQ(read_all(recording.get(), made.topics[1].name), written(made, 1));
}

TEST(Damage, ABagWhoseRecorderWasKilled) {
  for (const char* compression : {"none", "bz2", "lz4"}) {
    const TempFolder folder;
    const MadeRecording made = made_recording(Wire::kRos1);
    const std::string bytes = ros1_bag(made.topics, made.messages, compression, 1000, false);
    const auto recording = open_recording(write_bytes(folder, "x.bag", bytes));
    EXPECT_THAT(recording->missing(), HasSubstr("not closed by its recorder"));
    EXPECT_EQ(read_all(recording.get(), made.topics[1].name), written(made, 1));
  }
}

TEST(Damage, AFolderWithoutMetadata) {
  const TempFolder folder;
  const MadeRecording made = made_recording(Wire::kCdrLittle);
  const std::string path = write_split_db3(folder, made, "");
  std::filesystem::remove(path + "/metadata.yaml");
  const auto recording = open_recording(path);
  EXPECT_THAT(recording->missing(), HasSubstr("no metadata.yaml"));
  EXPECT_EQ(read_all(recording.get(), made.topics[1].name), written(made, 1));
}

TEST(Damage, OneOfSeveralFilesIsSkipped) {
  const TempFolder folder;
  const MadeRecording made = made_recording(Wire::kCdrLittle);
  const std::string path = write_mcap_folder(folder, made);
  write_bytes(folder, "ros2/x_1.mcap", "");
  EXPECT_THAT(missing(path), HasSubstr("x_1.mcap is skipped"));
}

TEST(Damage, FilesOfOlderRecordersAreFound) {
  const TempFolder folder;
  const MadeRecording made = made_recording(Wire::kCdrLittle);
  const std::string path = write_split_db3(folder, made, "FILE");
  write_bytes(folder, "ros2/metadata.yaml",
              ros2_metadata({"ros2/x_0.db3", "ros2/x_1.db3"}, made.topics, made.messages, "sqlite3", "FILE"));
  const auto recording = open_recording(path);
  EXPECT_THAT(recording->missing(), IsEmpty());
  EXPECT_EQ(read_all(recording.get(), made.topics[1].name), written(made, 1));
}

// A recorder with a write-ahead log was killed: its last messages are in the log.
TEST(Damage, TheLogNextToADatabaseIsRead) {
  const TempFolder folder;
  const MadeRecording made = made_recording(Wire::kCdrLittle);
  write_db3(folder / "live.db3", made.topics, made.messages);
  sqlite3* db = nullptr;
  sqlite3_open((folder / "live.db3").c_str(), &db);
  for (const char* sql :
       {"PRAGMA jour"
        "nal_mode=WAL",
        "PRAGMA wal_autocheckpoint=0",
        "INSERT INTO messages SELECT 1000, topic_id, timestamp + 1, data FROM messages WHERE id = 2"})
    sqlite3_exec(db, sql, nullptr, nullptr, nullptr);
  std::filesystem::copy_file(folder / "live.db3", folder / "x.db3");
  std::filesystem::copy_file(folder / "live.db3-wal", folder / "x.db3-wal");
  sqlite3_close(db);
  const auto recording = open_recording(folder / "x.db3");
  EXPECT_EQ(read_all(recording.get(), made.topics[1].name).size(), size_t(kMadeImages) + 1);
}

}  // namespace
}  // namespace edgevo::test
