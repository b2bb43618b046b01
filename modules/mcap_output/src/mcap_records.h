// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Records of an MCAP file (mcap.dev/spec, version 0): one byte that says which, the length of the content in
// eight bytes, the content; numbers little endian.
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace edgevo {

/// First and last bytes of a file.
inline constexpr std::string_view kMcapMagic{"\x89MCAP0\r\n", 8};

/// Which record.
enum class McapOpcode : uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

/// Names and values, in the order of the names.
using McapPairs = std::map<std::string, std::string>;

/// Appends the fields of a record, in the order of the specification.
class McapFields {
 public:
  /// An unsigned integer.
  template <class Number>
  McapFields& number(Number value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);  // x86-64 is little endian
    return *this;
  }
  /// A string or an array, after its length in four bytes.
  McapFields& text(std::string_view text) { return number(uint32_t(text.size())).raw(text); }
  /// Bytes as they are.
  McapFields& raw(std::string_view bytes) {
    bytes_.append(bytes);
    return *this;
  }
  /// A map of strings.
  McapFields& pairs(const McapPairs& pairs);
  /// The fields so far.
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// A kind of messages: a ROS 2 definition with all that it names.
struct McapSchema {
  /// Name, "nav_msgs/msg/Odometry".
  std::string name;
  /// Definition.
  std::string text;
};

/// A stream of messages of one kind.
struct McapChannel {
  /// Name of the topic.
  std::string topic;
  /// Name of the schema.
  std::string schema;
  /// What rosbag2 keeps of it.
  McapPairs metadata;
};

/// A whole record.
std::string mcap_record(McapOpcode opcode, std::string_view content);
/// Its first bytes, for a content of `size` bytes.
std::string mcap_record_head(McapOpcode opcode, uint64_t size);
/// Schema and channel by their numbers, from 1 and from 0.
std::string mcap_schema_record(uint16_t id, const McapSchema& schema);
/// See mcap_schema_record().
std::string mcap_channel_record(uint16_t id, uint16_t schema_id, const McapChannel& channel);

/// CRC-32 (that of zlib) of bytes that follow those of `before`.
uint32_t crc_after(uint32_t before, std::string_view bytes);

}  // namespace edgevo
