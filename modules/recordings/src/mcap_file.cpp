// SPDX-License-Identifier: BSD-3-Clause
#include "mcap_file.h"

#include <zlib.h>

#include <algorithm>

#include "chunked_recording.h"
#include "printable.h"
#include "unpack.h"

namespace edgevo {
namespace {

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);
enum Op : uint8_t {
  kFooter = 2,
  kSchema = 3,
  kChannel = 4,
  kMessage = 5,
  kChunk = 6,
  kMessageIndex = 7,
  kChunkIndex = 8,
  kStatistics = 11,
  kDataEnd = 15
};
constexpr uint64_t kRecordHead = 9;           // bytes: operation code and length
constexpr uint64_t kFooterContents = 20;      // bytes
constexpr uint64_t kMessageHead = 22;         // bytes: channel, sequence, two times
constexpr uint64_t kMaxDefinition = 1 << 26;  // bytes of a schema, a channel or an index that are believed

uint32_t checksum(uint32_t before, std::string_view bytes) {
  return uint32_t(crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

// Texts and numbers in the contents of a record.
class Contents {
 public:
  Contents(std::string_view bytes, const std::string& where) : bytes_(bytes), where_(where) {}
  template <class T>
  T number() {
    return RecordStream::number_in<T>(take(sizeof(T)));
  }
  std::string text() { return std::string(take(number<uint32_t>())); }
  // The bytes of a list or of a map, whose length is stated.
  Contents list() { return {take(number<uint32_t>()), where_}; }
  bool empty() const { return bytes_.empty(); }

 private:
  std::string_view take(size_t length) {
    if (length > bytes_.size()) throw DamagedPart(where_, "damaged record: it is too short", "it is skipped");
    const std::string_view taken = bytes_.substr(0, length);
    bytes_.remove_prefix(length);
    return taken;
  }

  std::string_view bytes_;
  std::string where_;
};

Serialization serialization_of(const std::string& encoding) {
  if (encoding == "cdr") return Serialization::kCdr;
  return encoding == "ros1" ? Serialization::kRos1 : Serialization::kOther;
}

class McapFile : public ChunkedRecording {
 public:
  explicit McapFile(const std::string& path) : ChunkedRecording(path) {
    check_magic();
    if (!read_summary()) scan();
    arrange(count_);
  }

  std::string kind() const override { return "MCAP"; }

 protected:
  std::unique_ptr<RecordStream> open_chunk(const Chunk& chunk) override;
  std::optional<RecordedMessage> next_in(RecordStream* chunk) override;
  void learn_channels(RecordStream* chunk) override;

 private:
  void check_magic();
  bool ends_with_magic();
  bool read_summary();
  uint64_t summary_begin();
  void check_summary(uint64_t begin, uint64_t end);
  void read_summary_records(uint64_t begin, uint64_t end);
  void scan();
  bool scan_record(FileStream* records);
  void add_definition(Op op, Contents contents);
  void add_chunk_index(Contents contents);
  void add_statistics(Contents contents);
  void add_message_index(Contents contents);
  void add_bare_message(uint64_t begin, uint64_t end, Contents contents);
  void check_plain(uint64_t begin, uint64_t end, uint32_t crc, const std::string& where);

  std::map<uint16_t, std::string> schemas_;
  std::map<uint32_t, int64_t> count_;  // messages by channel
};

void McapFile::check_magic() {
  const std::string_view begin = file_.read(0, kMagic.size());
  if (begin == kMagic) return;
  throw InputError(file_.path(), begin.empty() ? "is empty" : "is not an MCAP file", "give a recording");
}

bool McapFile::ends_with_magic() {
  return file_.size() >= kMagic.size() && file_.read(file_.size() - kMagic.size(), kMagic.size()) == kMagic;
}

// 0: no footer, or none that names a summary.
uint64_t McapFile::summary_begin() {
  const uint64_t footer = kRecordHead + kFooterContents + kMagic.size();
  if (file_.size() < footer + kMagic.size() || !ends_with_magic()) return 0;
  const std::string end(file_.read(file_.size() - footer, footer));
  if (end.size() != footer) return 0;
  Contents contents(end, file_.path());
  if (contents.number<uint8_t>() != kFooter || contents.number<uint64_t>() != kFooterContents) return 0;
  return contents.number<uint64_t>();
}

// False if there is none that leads to chunks, or it is damaged.
bool McapFile::read_summary() try {
  const uint64_t begin = summary_begin(),
                 footer = file_.size() - kMagic.size() - kFooterContents - kRecordHead;
  if (begin == 0) return false;
  if (begin < kMagic.size() || begin > footer) throw DamagedPart(file_.path(), "no summary", "");
  check_summary(begin, footer);
  read_summary_records(begin, footer);
  return !chunks_.empty();
} catch (const DamagedPart&) {
  chunks_.clear(), count_.clear();
  missing_ = "its summary is damaged: all chunks were looked for";
  return false;
}

// The checksum covers the summary and the footer up to the checksum itself.
void McapFile::check_summary(uint64_t begin, uint64_t footer) {
  const uint64_t end = footer + kRecordHead + 16;
  const uint32_t stated = RecordStream::number_in<uint32_t>(std::string(file_.read(end, 4)));
  if (stated != 0) check_plain(begin, end, stated, file_.path());
}

void McapFile::read_summary_records(uint64_t begin, uint64_t end) {
  FileStream records(&file_, begin, end, file_.path());
  while (records.remaining() > 0) {
    const Op op = Op(records.number<uint8_t>());
    const uint64_t length = records.number<uint64_t>();
    const Contents contents(records.read_head(length, kMaxDefinition), file_.path());
    if (op == kSchema || op == kChannel) add_definition(op, contents);
    if (op == kChunkIndex) add_chunk_index(contents);
    if (op == kStatistics) add_statistics(contents);
  }
}

void McapFile::add_definition(Op op, Contents contents) {
  const auto id = contents.number<uint16_t>();
  if (op == kSchema) {
    schemas_[id] = printable(contents.text());
    return;
  }
  const auto schema = schemas_.find(contents.number<uint16_t>());
  RecordedTopic topic;
  topic.name = printable(contents.text());
  topic.encoding = printable(contents.text());
  topic.serialization = serialization_of(topic.encoding);
  topic.type = schema == schemas_.end() ? "no schema" : ros1_type(schema->second);
  add_channel(id, topic);
}

void McapFile::add_chunk_index(Contents contents) {
  Chunk chunk;
  chunk.start_ns = contents.number<int64_t>();
  contents.number<uint64_t>();  // time of its last message
  chunk.begin = contents.number<uint64_t>();
  const auto length = contents.number<uint64_t>();
  if (chunk.begin > file_.size() || length > file_.size() - chunk.begin)
    throw DamagedPart(file_.path(), "the index leads out of the file", "");
  chunk.end = chunk.begin + length;
  std::map<uint32_t, int64_t> channels;
  for (Contents offsets = contents.list(); !offsets.empty(); offsets.number<uint64_t>())
    channels[offsets.number<uint16_t>()] = 0;
  if (!channels.empty()) chunk.messages = channels;
  chunks_.push_back(chunk);
}

void McapFile::add_statistics(Contents contents) {
  contents.number<uint64_t>();                              // all messages
  contents.number<uint16_t>();                              // schemas
  for (int i = 0; i < 4; ++i) contents.number<uint32_t>();  // channels, attachments, metadata, chunks
  for (int i = 0; i < 2; ++i) contents.number<uint64_t>();  // first and last time
  for (Contents counts = contents.list(); !counts.empty();) {
    const auto channel = counts.number<uint16_t>();
    count_[channel] = int64_t(counts.number<uint64_t>());
  }
}

// Reads the heads of all records from the beginning.
void McapFile::scan() {
  FileStream records(&file_, kMagic.size(), file_.size(), file_.path());
  uint64_t end_of_whole = records.position();
  bool is_closed = false;
  try {
    while (records.remaining() > 0 && !is_closed) {
      is_closed = !scan_record(&records);
      end_of_whole = records.position();
    }
  } catch (const DamagedPart&) {
  }
  if (is_closed && missing_.empty() && !ends_with_magic())
    missing_ = "cut off in its index; its messages are whole";
  if (!is_closed) set_cut_off(end_of_whole, chunks_.empty() || !chunks_.back().is_bare ? "chunk" : "message");
}

// False for the record that ends the data.
bool McapFile::scan_record(FileStream* records) {
  const uint64_t begin = records->position();
  const Op op = Op(records->number<uint8_t>());
  const uint64_t length = records->number<uint64_t>();
  const bool is_definition = op == kSchema || op == kChannel || op == kMessageIndex;
  const std::string_view head = records->read_head(length, is_definition ? kMaxDefinition : kMessageHead);
  const Contents contents(head, file_.path());
  if (op == kSchema || op == kChannel) add_definition(op, contents);
  if (op == kMessageIndex) add_message_index(contents);
  if (op == kMessage) add_bare_message(begin, records->position(), contents);
  if (op == kChunk) {
    Chunk chunk;
    chunk.begin = begin, chunk.end = records->position();
    chunk.start_ns = Contents(head, file_.path()).number<int64_t>();
    chunks_.push_back(chunk);
  }
  return op != kDataEnd && op != kFooter;
}

// The index of the chunk before it: times and places of the messages of a channel.
void McapFile::add_message_index(Contents contents) {
  if (chunks_.empty() || chunks_.back().is_bare) return;
  const auto channel = contents.number<uint16_t>();
  const auto bytes = contents.number<uint32_t>();
  constexpr uint32_t kEntry = 16;  // bytes: time and place
  if (bytes < kEntry) return;
  if (!chunks_.back().messages) chunks_.back().messages.emplace();
  (*chunks_.back().messages)[channel] += bytes / kEntry;
}

// Messages in a row are one chunk, whatever lies between them; no longer than 16 MB, so that those without a
// chosen topic are skipped.
void McapFile::add_bare_message(uint64_t begin, uint64_t end, Contents contents) {
  constexpr uint64_t kMaxBare = 1 << 24;
  const auto channel = contents.number<uint16_t>();
  contents.number<uint32_t>();  // sequence
  const auto time = contents.number<int64_t>();
  if (chunks_.empty() || !chunks_.back().is_bare || end - chunks_.back().begin > kMaxBare) {
    Chunk chunk;
    chunk.begin = begin, chunk.start_ns = time, chunk.is_bare = true;
    chunk.messages.emplace();
    chunks_.push_back(chunk);
  }
  chunks_.back().end = end;
  ++(*chunks_.back().messages)[channel];
}

std::unique_ptr<RecordStream> McapFile::open_chunk(const Chunk& chunk) {
  const std::string where = name_of(chunk);
  if (chunk.is_bare) return std::make_unique<FileStream>(&file_, chunk.begin, chunk.end, where);
  FileStream record(&file_, chunk.begin, chunk.end, where);
  if (record.number<uint8_t>() != kChunk) throw DamagedPart(where, "is no chunk", "it is skipped");
  record.skip(3 * sizeof(uint64_t));  // length, first and last time
  const auto size = record.number<uint64_t>();
  const auto crc = record.number<uint32_t>();
  const std::string name(record.read(record.number<uint32_t>()));
  const Compression compression = compression_of(name, where);
  const auto length = record.number<uint64_t>();
  if (length > record.remaining()) throw DamagedPart(where, "is cut off", "it is skipped");
  const uint64_t begin = record.position(), end = begin + length;
  if (compression == Compression::kNone) {
    if (crc != 0) check_plain(begin, end, crc, where);
    return std::make_unique<FileStream>(&file_, begin, end, where);
  }
  std::string bytes = unpack(compression, record.read(length), size, where);
  if (crc != 0 && checksum(0, bytes) != crc)
    throw DamagedPart(where, "has a wrong checksum", "it is skipped");
  return std::make_unique<MemoryStream>(std::move(bytes), where);
}

void McapFile::check_plain(uint64_t begin, uint64_t end, uint32_t crc, const std::string& where) {
  constexpr uint64_t kPiece = 1 << 20;
  uint32_t sum = 0;
  for (uint64_t at = begin; at < end; at += kPiece)
    sum = checksum(sum, file_.read(at, size_t(std::min(kPiece, end - at))));
  if (sum != crc) throw DamagedPart(where, "has a wrong checksum", "it is skipped");
}

std::optional<RecordedMessage> McapFile::next_in(RecordStream* chunk) {
  while (chunk->remaining() > 0) {
    const Op op = Op(chunk->number<uint8_t>());
    const auto length = chunk->number<uint64_t>();
    if (op != kMessage || length < kMessageHead) {
      chunk->skip(length);
      continue;
    }
    Contents head(chunk->read(kMessageHead), file_.path());
    const auto topic = wanted_topic(head.number<uint16_t>());
    head.number<uint32_t>();  // sequence
    const auto time = head.number<int64_t>();
    if (topic) return RecordedMessage{*topic, time, chunk->read_head(length - kMessageHead, head_bytes())};
    chunk->skip(length - kMessageHead);
  }
  return std::nullopt;
}

void McapFile::learn_channels(RecordStream* chunk) {
  while (chunk->remaining() > 0) {
    const Op op = Op(chunk->number<uint8_t>());
    const auto length = chunk->number<uint64_t>();
    const bool is_definition = op == kSchema || op == kChannel;
    const std::string_view contents = chunk->read_head(length, is_definition ? kMaxDefinition : 0);
    if (is_definition) add_definition(op, Contents(contents, file_.path()));
  }
}

}  // namespace

std::unique_ptr<Recording> open_mcap(const std::string& path) { return std::make_unique<McapFile>(path); }

}  // namespace edgevo
