// SPDX-License-Identifier: BSD-3-Clause
#include "ros1_bag.h"

#include "chunked_recording.h"
#include "printable.h"
#include "unpack.h"

namespace edgevo {
namespace {

constexpr std::string_view kMagic = "#ROSBAG V2.0\n";
// Values of the field `op`.
constexpr uint8_t kMessage = 2, kBagHeader = 3, kIndexData = 4, kChunk = 5, kChunkInfo = 6, kConnection = 7;

// The fields of a record's header or of a connection.
class Fields {
 public:
  // Throws DamagedPart, opened by `where`, if the lengths do not fit.
  Fields(std::string_view bytes, const std::string& where) : where_(where) {
    while (!bytes.empty()) {
      if (bytes.size() < 4) fail("a field without a length");
      const uint32_t length = RecordStream::number_in<uint32_t>(bytes);
      bytes.remove_prefix(4);
      const std::string_view field = bytes.substr(0, length);
      const size_t equals = field.find('=');
      if (length > bytes.size() || equals == std::string_view::npos) fail("a field without a name");
      values_.emplace(std::string(field.substr(0, equals)), std::string(field.substr(equals + 1)));
      bytes.remove_prefix(length);
    }
  }
  // Empty: it has no such field.
  std::string text(const std::string& name) const {
    const auto value = values_.find(name);
    return value == values_.end() ? std::string() : value->second;
  }
  template <class T>
  T number(const std::string& name) const {
    const std::string value = text(name);
    if (value.size() != sizeof(T)) fail("no field '" + name + "' of " + std::to_string(sizeof(T)) + " bytes");
    return RecordStream::number_in<T>(value);
  }
  // Seconds and nanoseconds, as nanoseconds.
  int64_t time(const std::string& name) const {
    const auto value = number<uint64_t>(name);
    return int64_t(value & 0xffffffff) * 1'000'000'000 + int64_t(value >> 32);
  }
  uint8_t op() const { return number<uint8_t>("op"); }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw DamagedPart(where_, "damaged record: " + what, "it is skipped");
  }

  std::string where_;
  std::map<std::string, std::string> values_;
};

class Ros1Bag : public ChunkedRecording {
 public:
  explicit Ros1Bag(const std::string& path) : ChunkedRecording(path) {
    check_magic();
    FileStream records(&file_, kMagic.size(), file_.size(), path);
    const uint64_t index_at = read_bag_header(&records);
    const uint64_t first = records.position();
    if (index_at < first || !read_index(index_at)) scan(first, index_at);
    arrange({});
  }

  std::string kind() const override { return "ROS 1 bag"; }

 protected:
  std::unique_ptr<RecordStream> open_chunk(const Chunk& chunk) override;
  std::optional<RecordedMessage> next_in(RecordStream* chunk) override;
  void learn_channels(RecordStream* chunk) override;

 private:
  void check_magic();
  uint64_t read_bag_header(FileStream* records);
  bool read_index(uint64_t index_at);
  void scan(uint64_t first, uint64_t index_at);
  void add_connection(const Fields& header, std::string_view data);
  void add_chunk_info(const Fields& header, std::string_view data);
  void add_index_data(const Fields& header, std::string_view data);
  Fields read_header(RecordStream* records) const {
    return {records->read(records->number<uint32_t>()), file_.path()};
  }
};

void Ros1Bag::check_magic() {
  const std::string_view begin = file_.read(0, kMagic.size());
  if (begin == kMagic) return;
  if (begin.substr(0, 9) == "#ROSBAG V")
    throw InputError(file_.path(),
                     "a ROS bag of version " + printable(begin.substr(9, 3)) + ", which is not read",
                     "convert it with `rosbag migrate`");
  throw InputError(file_.path(), begin.empty() ? "is empty" : "is not a ROS 1 bag",
                   "its first line should be #ROSBAG V2.0");
}

// The place of the index; 0: none.
uint64_t Ros1Bag::read_bag_header(FileStream* records) try {
  const Fields header = read_header(records);
  if (header.op() != kBagHeader) throw DamagedPart(file_.path(), "does not begin with a bag header", "");
  if (!header.text("encryptor").empty())
    throw InputError(file_.path(), "is encrypted (" + printable(header.text("encryptor")) + ")",
                     "decrypt it");
  records->skip(records->number<uint32_t>());
  return header.number<uint64_t>("index_pos");
} catch (const DamagedPart&) {
  throw InputError(file_.path(), "has no whole bag header", "record again, or look for a copy");
}

// False if it is not whole.
bool Ros1Bag::read_index(uint64_t index_at) {
  if (index_at >= file_.size()) return false;
  FileStream records(&file_, index_at, file_.size(), file_.path());
  try {
    while (records.remaining() > 0) {
      const Fields header = read_header(&records);
      const std::string_view data = records.read(records.number<uint32_t>());
      if (header.op() == kConnection) add_connection(header, data);
      if (header.op() == kChunkInfo) add_chunk_info(header, data);
    }
    return true;
  } catch (const DamagedPart&) {
    chunks_.clear();
    return false;
  }
}

// Reads the heads of all records from the beginning.
void Ros1Bag::scan(uint64_t first, uint64_t index_at) {
  FileStream records(&file_, first, file_.size(), file_.path());
  uint64_t end_of_whole = first;
  try {
    while (records.remaining() > 0) {
      const Fields header = read_header(&records);
      const uint32_t length = records.number<uint32_t>();
      const uint8_t op = header.op();
      if (op == kChunk) {
        records.skip(length);
        Chunk chunk;
        chunk.begin = end_of_whole, chunk.end = records.position();
        if (!chunks_.empty()) chunk.start_ns = chunks_.back().start_ns;  // until its index says
        chunks_.push_back(chunk);
      } else {
        const std::string_view data = records.read(length);
        if (op == kConnection) add_connection(header, data);
        if (op == kIndexData && !chunks_.empty()) add_index_data(header, data);
      }
      end_of_whole = records.position();
    }
  } catch (const DamagedPart&) {
  }
  set_cut_off(end_of_whole, "chunk");
  if (index_at > file_.size())
    missing_ += ", and at least " + with_commas(index_at - file_.size()) + " are missing";
}

void Ros1Bag::add_connection(const Fields& header, std::string_view data) {
  const Fields connection(data, file_.path());
  RecordedTopic topic;
  topic.name = printable(header.text("topic"));
  topic.type = printable(connection.text("type"));
  topic.serialization = Serialization::kRos1;
  topic.encoding = "ros1";
  add_channel(header.number<uint32_t>("conn"), topic);
}

void Ros1Bag::add_chunk_info(const Fields& header, std::string_view data) {
  Chunk chunk;
  chunk.begin = header.number<uint64_t>("chunk_pos");
  chunk.end = chunk.begin;
  chunk.start_ns = header.time("start_time");
  chunk.messages.emplace();
  for (; data.size() >= 8; data.remove_prefix(8))
    (*chunk.messages)[RecordStream::number_in<uint32_t>(data)] +=
        RecordStream::number_in<uint32_t>(data.substr(4));
  chunks_.push_back(chunk);
}

// The index of the chunk before it: times and places of the messages of a connection.
void Ros1Bag::add_index_data(const Fields& header, std::string_view data) {
  Chunk& chunk = chunks_.back();
  const bool is_first = !chunk.messages;
  if (is_first) chunk.messages.emplace();
  (*chunk.messages)[header.number<uint32_t>("conn")] += header.number<uint32_t>("count");
  if (data.size() < 8) return;
  const auto time = RecordStream::number_in<uint64_t>(data);
  const int64_t ns = int64_t(time & 0xffffffff) * 1'000'000'000 + int64_t(time >> 32);
  if (is_first || ns < chunk.start_ns) chunk.start_ns = ns;
}

std::unique_ptr<RecordStream> Ros1Bag::open_chunk(const Chunk& chunk) {
  const std::string where = name_of(chunk);
  FileStream record(&file_, std::min(chunk.begin, file_.size()), file_.size(), where);
  const Fields header = read_header(&record);
  if (header.op() != kChunk) throw DamagedPart(where, "is no chunk", "it is skipped");
  const Compression compression = compression_of(header.text("compression"), where);
  const uint32_t length = record.number<uint32_t>();
  if (length > record.remaining()) throw DamagedPart(where, "is cut off", "it is skipped");
  if (compression == Compression::kNone)
    return std::make_unique<FileStream>(&file_, record.position(), record.position() + length, where);
  const uint32_t size = header.number<uint32_t>("size");
  return std::make_unique<MemoryStream>(unpack(compression, record.read(length), size, where), where);
}

std::optional<RecordedMessage> Ros1Bag::next_in(RecordStream* chunk) {
  while (chunk->remaining() > 0) {
    const Fields header = read_header(chunk);
    const uint32_t length = chunk->number<uint32_t>();
    const auto topic = header.op() == kMessage ? wanted_topic(header.number<uint32_t>("conn")) : std::nullopt;
    if (topic) return RecordedMessage{*topic, header.time("time"), chunk->read_head(length, head_bytes())};
    chunk->skip(length);
  }
  return std::nullopt;
}

void Ros1Bag::learn_channels(RecordStream* chunk) {
  while (chunk->remaining() > 0) {
    const Fields header = read_header(chunk);
    const uint32_t length = chunk->number<uint32_t>();
    if (header.op() == kConnection)
      add_connection(header, chunk->read(length));
    else
      chunk->skip(length);
  }
}

}  // namespace

std::unique_ptr<Recording> open_ros1_bag(const std::string& path) { return std::make_unique<Ros1Bag>(path); }

}  // namespace edgevo
