// SPDX-License-Identifier: BSD-3-Clause
#include "mcap_file.h"

#include <zstd.h>

#include <algorithm>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

// Bytes of a chunk before it is compressed: large enough to compress well, small enough to be read at once.
constexpr size_t kChunkBytes = 512 << 10;
// Time in a chunk, nanoseconds: what the death of the program costs at most.
constexpr uint64_t kChunkTime = 2'000'000'000;
// Of zstd: above it a chunk gets 3 % smaller and takes twice the time.
constexpr int kLevel = 3;

uint64_t nanoseconds(Timestamp t) { return uint64_t(std::max<int64_t>(t.ticks, 0)) * 100; }

std::string compressed(const std::string& bytes) {
  std::string result(ZSTD_compressBound(bytes.size()), '\0');
  const size_t size = ZSTD_compress(result.data(), result.size(), bytes.data(), bytes.size(), kLevel);
  if (ZSTD_isError(size)) throw InputError("run.mcap", ZSTD_getErrorName(size), "free memory");
  result.resize(size);
  return result;
}

std::string message_record(uint16_t channel, uint32_t sequence, uint64_t time, std::string_view bytes) {
  return mcap_record(
      McapOpcode::kMessage,
      McapFields().number(channel).number(sequence).number(time).number(time).raw(bytes).bytes());
}

std::string bytes_of(const std::map<uint16_t, uint64_t>& numbers) {
  McapFields fields;
  for (const auto& [channel, number] : numbers) fields.number(channel).number(number);
  return fields.bytes();
}

}  // namespace

McapFile::McapFile(const std::string& path, const std::string& library) : out_(path) {
  write(kMcapMagic);
  write(mcap_record(McapOpcode::kHeader, McapFields().text("ros2").text(library).bytes()));
  out_.flush();
}

void McapFile::write(std::string_view bytes) {
  out_.write(bytes);
  size_ += bytes.size();
  crc_ = crc_after(crc_, bytes);
}

uint16_t McapFile::add_channel(McapChannel channel) {
  channels_.push_back({std::move(channel)});
  return uint16_t(channels_.size() - 1);
}

// Writes channel and schema into the chunk, before the first message.
void McapFile::declare(uint16_t number) {
  Channel& channel = channels_[number];
  if (std::exchange(channel.is_written, true)) return;
  Schema& schema = schemas_.at(channel.channel.schema);
  if (schema.id == 0) {
    written_schemas_.push_back(channel.channel.schema);
    schema.id = uint16_t(written_schemas_.size());
    chunk_.records += mcap_schema_record(schema.id, {channel.channel.schema, schema.text});
  }
  chunk_.records += mcap_channel_record(number, schema.id, channel.channel);
}

void McapFile::add_message(uint16_t channel, Timestamp time, std::string_view bytes) {
  const uint64_t now = std::max(nanoseconds(time), end_);
  if (!chunk_.index.empty() && now - chunk_.start > kChunkTime) end_chunk();
  declare(channel);
  if (chunk_.index.empty()) chunk_.start = now;
  if (messages_++ == 0) start_ = now;
  chunk_.end = end_ = now;
  chunk_.index[channel].emplace_back(now, chunk_.records.size());
  chunk_.records += message_record(channel, uint32_t(channels_[channel].messages++), now, bytes);
  if (chunk_.records.size() > kChunkBytes) end_chunk();
}

std::string McapFile::message_indices(uint64_t offset, std::map<uint16_t, uint64_t>* offsets) const {
  std::string records;
  for (const auto& [channel, messages] : chunk_.index) {
    (*offsets)[channel] = offset + records.size();
    McapFields entries;
    for (const auto& [time, place] : messages) entries.number(time).number(place);
    records +=
        mcap_record(McapOpcode::kMessageIndex, McapFields().number(channel).text(entries.bytes()).bytes());
  }
  return records;
}

void McapFile::end_chunk() {
  if (chunk_.index.empty()) return;
  const std::string packed = compressed(chunk_.records);
  const std::string head = McapFields()
                               .number(chunk_.start)
                               .number(chunk_.end)
                               .number(uint64_t(chunk_.records.size()))
                               .number(crc_after(0, chunk_.records))
                               .text("zstd")
                               .number(uint64_t(packed.size()))
                               .bytes();
  std::string record = mcap_record_head(McapOpcode::kChunk, head.size() + packed.size()) + head + packed;
  const uint64_t length = record.size();
  std::map<uint16_t, uint64_t> index_offsets;
  record += message_indices(size_ + length, &index_offsets);
  note_chunk(size_, length, packed.size(), index_offsets, record.size() - length);
  write(record);
  out_.flush();
  chunk_ = {};
}

void McapFile::note_chunk(uint64_t offset, uint64_t length, uint64_t compressed_size,
                          const std::map<uint16_t, uint64_t>& index_offsets, uint64_t index_length) {
  ++chunks_;
  chunk_indices_ += mcap_record(McapOpcode::kChunkIndex, McapFields()
                                                             .number(chunk_.start)
                                                             .number(chunk_.end)
                                                             .number(offset)
                                                             .number(length)
                                                             .text(bytes_of(index_offsets))
                                                             .number(index_length)
                                                             .text("zstd")
                                                             .number(compressed_size)
                                                             .number(uint64_t(chunk_.records.size()))
                                                             .bytes());
}

std::string McapFile::statistics() const {
  std::map<uint16_t, uint64_t> counts;
  for (size_t i = 0; i < channels_.size(); ++i)
    if (channels_[i].is_written) counts[uint16_t(i)] = channels_[i].messages;
  return mcap_record(McapOpcode::kStatistics, McapFields()
                                                  .number(messages_)
                                                  .number(uint16_t(written_schemas_.size()))
                                                  .number(uint32_t(counts.size()))
                                                  .number(uint32_t(0))  // attachments
                                                  .number(uint32_t(1))  // metadata
                                                  .number(chunks_)
                                                  .number(start_)
                                                  .number(end_)
                                                  .text(bytes_of(counts))
                                                  .bytes());
}

void McapFile::finish(const std::string& metadata_name, const McapPairs& metadata) {
  end_chunk();
  const uint64_t place = size_;
  const std::string record =
      mcap_record(McapOpcode::kMetadata, McapFields().text(metadata_name).pairs(metadata).bytes());
  write(record);
  write(mcap_record(McapOpcode::kDataEnd, McapFields().number(crc_).bytes()));
  write_summary(
      mcap_record(McapOpcode::kMetadataIndex,
                  McapFields().number(place).number(uint64_t(record.size())).text(metadata_name).bytes()));
  out_.close();
}

// The groups of records, where each begins, and the footer with a checksum of all that.
void McapFile::write_summary(const std::string& metadata_index) {
  std::string schemas, channels;
  for (const std::string& name : written_schemas_)
    schemas += mcap_schema_record(schemas_.at(name).id, {name, schemas_.at(name).text});
  for (size_t i = 0; i < channels_.size(); ++i)
    if (channels_[i].is_written)
      channels +=
          mcap_channel_record(uint16_t(i), schemas_.at(channels_[i].channel.schema).id, channels_[i].channel);
  const std::pair<McapOpcode, std::string> groups[] = {{McapOpcode::kSchema, schemas},
                                                       {McapOpcode::kChannel, channels},
                                                       {McapOpcode::kStatistics, statistics()},
                                                       {McapOpcode::kChunkIndex, chunk_indices_},
                                                       {McapOpcode::kMetadataIndex, metadata_index}};
  std::string summary, offsets;
  for (const auto& [opcode, records] : groups) {
    if (records.empty()) continue;
    offsets += mcap_record(McapOpcode::kSummaryOffset, McapFields()
                                                           .number(uint8_t(opcode))
                                                           .number(size_ + summary.size())
                                                           .number(uint64_t(records.size()))
                                                           .bytes());
    summary += records;
  }
  const uint64_t start = size_;
  const std::string places = McapFields().number(start).number(start + summary.size()).bytes();
  summary += offsets + mcap_record_head(McapOpcode::kFooter, places.size() + sizeof(uint32_t)) + places;
  write(summary + McapFields().number(crc_after(0, summary)).bytes());
  write(kMcapMagic);
}

}  // namespace edgevo
