// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Recordings of ROS, read without ROS: messages of chosen topics, in the order of the file.
//
//   *.bag           ROS 1 bag 2.0; chunks plain, bz2, lz4
//   *.mcap          MCAP; with or without chunks, index and summary; chunks plain, lz4, zstd
//   *.db3           ROS 2 bag in SQLite
//   *.db3.zstd, *.mcap.zstd   the same, compressed as a whole file; unpacked into the temporary folder
//   *.db3.zstd, *.mcap.zstd   the same, compressed as a whole; unpacked into the temporary folder
//                   was killed) the .db3 or .mcap files in it; messages may be compressed by zstd one by one
//
// A file that was cut off is read to its last whole chunk (.db3: message). Chunks are read in the order of
// their first times, and messages in a chunk as they were written: those of one topic come in the order of
// arrival. Memory: one chunk; of a plain chunk, one message.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "edgevo/core/error.h"

namespace edgevo {

/// How the bytes of messages are laid out.
enum class Serialization {
  kRos1,  ///< ROS 1: little endian, packed.
  kCdr,   ///< Common Data Representation of OMG, as in ROS 2.
  kOther  ///< Another one, which is not read.
};

/// A topic of a recording.
struct RecordedTopic {
  /// Name, as in "/camera/image_raw".
  std::string name;
  /// Type of its messages in the form of ROS 1, "sensor_msgs/Image", for ROS 2 as well.
  std::string type;
  /// Layout of its messages.
  Serialization serialization = Serialization::kOther;
  /// Its name in the file: "ros1", "cdr", "protobuf".
  std::string encoding;
  /// Number of messages; nullopt if the file has to be read to count them.
  std::optional<int64_t> messages;
};

/// A message as recorded.
struct RecordedMessage {
  /// Its topic: position in Recording::topics().
  size_t topic = 0;
  /// When it was recorded, nanoseconds since the epoch of the recorder's clock.
  int64_t recorded_ns = 0;
  /// Its bytes, possibly only the first; valid until the next call.
  std::string_view bytes;
};

/// Which messages are read.
struct MessageSelection {
  /// Positions in Recording::topics().
  std::vector<size_t> topics;
  /// Bytes read of a message from its beginning; the rest is not read where that saves time.
  size_t head_bytes = SIZE_MAX;
  /// Bytes of the file after which reading ends, of those parts that may hold none of these messages: for a
  /// search that a file without an index does not support.
  uint64_t search_bytes = UINT64_MAX;
};

/// A part of a recording that cannot be read: a chunk with a wrong checksum, for example. Reading may go on
/// behind it.
class DamagedPart : public InputError {
 public:
  using InputError::InputError;
};

/// Messages in a file or a folder. One thread at a time.
class Recording {
 public:
  virtual ~Recording() = default;

  /// Kind in words: "ROS 1 bag", "MCAP", "ROS 2 bag (SQLite)".
  virtual std::string kind() const = 0;
  /// All topics, sorted by name.
  virtual const std::vector<RecordedTopic>& topics() const = 0;
  /// What is missing of the file, as a phrase ("cut off: ..."); empty: nothing that can be seen.
  virtual std::string missing() const = 0;
  /// Goes back to the beginning and chooses what next() returns.
  virtual void select(const MessageSelection& selection) = 0;
  /// The next message; nullopt at the end. Throws DamagedPart, after which it may be called again.
  virtual std::optional<RecordedMessage> next() = 0;
};

/// Whether `path` names a recording: a file by its ending, a folder by metadata.yaml of ROS 2 or by .db3 or
/// .mcap files in it.
bool is_recording(const std::string& path);

/// Opens a recording. Reads its index; of a file without one the heads of its chunks, and those chunks that
/// show a new topic. Throws InputError: no such file, not of the kind that its ending says, of a version or
/// compression that is not read, nothing whole in it.
std::unique_ptr<Recording> open_recording(const std::string& path);

}  // namespace edgevo
