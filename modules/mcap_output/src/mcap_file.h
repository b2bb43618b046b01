// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An MCAP file that grows: whole chunks of messages, each passed to the system at once, so that a file cut
// off anywhere holds all chunks before the cut; at the end the summary, by which readers find what they want.
//
//   magic  Header  (Chunk  MessageIndex ...) ...  Metadata  DataEnd  summary  Footer  magic
//
// The chunk of the first message of a channel has its schema and itself, and so has the summary.
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "edgevo/core/output_file.h"
#include "edgevo/core/timestamp.h"
#include "mcap_records.h"

namespace edgevo {

/// Writes one file. All functions throw InputError when it cannot be written.
class McapFile {
 public:
  /// Begins the file. `library`: name and version of the program.
  McapFile(const std::string& path, const std::string& library);

  /// Announces a kind of messages; it is written before the first of them.
  void add_schema(McapSchema schema) { schemas_[schema.name] = {0, std::move(schema.text)}; }
  /// Announces a channel, whose schema is known, and returns its number.
  uint16_t add_channel(McapChannel channel);
  /// Appends a message. `time`: when it was known, not before those before it.
  void add_message(uint16_t channel, Timestamp time, std::string_view bytes);
  /// Ends the chunk: from here on its messages survive the death of the program.
  void end_chunk();
  /// Writes the rest and closes. Call once, last.
  void finish(const std::string& metadata_name, const McapPairs& metadata);

 private:
  struct Schema {
    uint16_t id = 0;  // 0: not written yet
    std::string text;
  };
  struct Channel {
    McapChannel channel;
    uint64_t messages = 0;
    bool is_written = false;
  };
  struct Chunk {
    std::string records;
    uint64_t start = 0, end = 0;  // nanoseconds
    // By channel: time and offset in `records` of each message.
    std::map<uint16_t, std::vector<std::pair<uint64_t, uint64_t>>> index;
  };

  void write(std::string_view bytes);
  void declare(uint16_t channel);
  std::string message_indices(uint64_t offset, std::map<uint16_t, uint64_t>* offsets) const;
  void note_chunk(uint64_t offset, uint64_t length, uint64_t compressed_size,
                  const std::map<uint16_t, uint64_t>& index_offsets, uint64_t index_length);
  std::string statistics() const;
  void write_summary(const std::string& metadata_index);

  OutputFile out_;
  uint64_t size_ = 0;  // bytes written
  uint32_t crc_ = 0;   // of all bytes so far
  std::map<std::string, Schema> schemas_;
  std::vector<Channel> channels_;
  std::vector<std::string> written_schemas_;  // names, by number less 1
  Chunk chunk_;
  std::string chunk_indices_;  // records
  uint64_t messages_ = 0, start_ = 0, end_ = 0;
  uint32_t chunks_ = 0;
};

}  // namespace edgevo
