// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What ROS 1 bags and MCAP have in common: messages of numbered channels in chunks.
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "edgevo/recordings/recording.h"
#include "random_file.h"
#include "record_stream.h"

namespace edgevo {

/// A part of the file that is read in one go.
struct Chunk {
  /// Its bytes in the file, from the head of its record on.
  uint64_t begin = 0, end = 0;
  /// Time of its first message, nanoseconds.
  int64_t start_ns = 0;
  /// Whether it consists of records of the file itself, not of a chunk record.
  bool is_bare = false;
  /// Number of messages by channel; 0: some. Nullopt: the file does not say which channels it has.
  std::optional<std::map<uint32_t, int64_t>> messages;
};

/// A recording in chunks. Derived classes find topics and chunks in their constructor, then call arrange().
class ChunkedRecording : public Recording {
 public:
  const std::vector<RecordedTopic>& topics() const override { return topics_; }
  std::string missing() const override { return missing_; }
  void select(const MessageSelection& selection) override;
  std::optional<RecordedMessage> next() override;

 protected:
  explicit ChunkedRecording(const std::string& path) : file_(path) {}

  /// A chunk as records. Throws DamagedPart.
  virtual std::unique_ptr<RecordStream> open_chunk(const Chunk& chunk) = 0;
  /// The next message in a chunk that is_wanted(), as `head_bytes()` says; nullopt at its end.
  virtual std::optional<RecordedMessage> next_in(RecordStream* chunk) = 0;
  /// Adds the channels that the records of a chunk define.
  virtual void learn_channels(RecordStream* chunk) = 0;

  /// Adds a channel; two of the same topic and type become one topic.
  void add_channel(uint32_t id, const RecordedTopic& topic);
  bool knows_channel(uint32_t id) const { return topic_of_.count(id) > 0; }
  /// The topic of a channel whose messages were chosen; nullopt: not chosen, or unknown.
  std::optional<size_t> wanted_topic(uint32_t id) const;
  uint64_t head_bytes() const { return selection_.head_bytes; }
  /// Reads chunks with channels that are not known; sorts chunks and topics; counts the messages of the
  /// topics by those of the chunks unless `count` is set by channel. Throws InputError for a file without
  /// chunks that was cut off.
  void arrange(const std::map<uint32_t, int64_t>& count);
  /// "PATH, chunk at byte N".
  std::string name_of(const Chunk& chunk) const;
  /// Sets missing(): the file holds no index since it was cut off at `end_of_whole`, or was not closed.
  void set_cut_off(uint64_t end_of_whole, const std::string& part);

  RandomFile file_;
  std::vector<Chunk> chunks_;
  std::string missing_;

 private:
  void learn_all_channels();
  void sort_topics();
  void count_messages(const std::map<uint32_t, int64_t>& count);
  bool may_hold_wanted(const Chunk& chunk);
  bool open_next_chunk();

  std::vector<RecordedTopic> topics_;
  std::map<uint32_t, size_t> topic_of_;  // by channel
  MessageSelection selection_;
  std::vector<bool> wanted_;  // by topic
  size_t next_chunk_ = 0;
  uint64_t searched_ = 0;  // bytes
  std::unique_ptr<RecordStream> chunk_;
};

/// "1,234,567".
std::string with_commas(uint64_t number);

/// A type in the form of ROS 1: "sensor_msgs/msg/Image" becomes "sensor_msgs/Image".
std::string ros1_type(const std::string& type);

}  // namespace edgevo
