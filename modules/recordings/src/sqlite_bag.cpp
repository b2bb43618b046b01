// SPDX-License-Identifier: BSD-3-Clause
#include "sqlite_bag.h"

#include <sqlite3.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "chunked_recording.h"
#include "printable.h"
#include "random_file.h"
#include "unpack.h"
#include "whole_pages.h"

namespace edgevo {
namespace {

using Database = std::unique_ptr<sqlite3, int (*)(sqlite3*)>;
using Statement = std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)>;

// The log next to a file whose recorder was killed holds its last messages, and needs SQLite's own access.
Database open_database(const std::string& path) {
  const bool has_log = std::filesystem::exists(path + "-wal");
  sqlite3* opened = nullptr;
  const int result =
      sqlite3_open_v2(path.c_str(), &opened, SQLITE_OPEN_READONLY, has_log ? nullptr : whole_pages_vfs());
  Database database(opened, sqlite3_close);
  if (result != SQLITE_OK)
    throw InputError(path, "cannot be read by SQLite", "check the file and its permissions");
  // A file that is shorter than its first page says is read as far as it goes.
  sqlite3_exec(opened,
               "PRAGMA writable_schema=ON; PRAGMA trusted_schema=OFF; PRAGMA cell_size_check=ON; PRAGMA "
               "cache_size=-2000",
               nullptr, nullptr, nullptr);
  return database;
}

std::string text_in(sqlite3_stmt* row, int column) {
  const auto* text = sqlite3_column_text(row, column);
  return text ? printable(reinterpret_cast<const char*>(text)) : "";
}

class SqliteBag : public Recording {
 public:
  explicit SqliteBag(const std::string& path) : path_(path), database_(open_database(path)) {
    check_magic();
    read_topics();
    if (missing_.empty()) count_messages();
  }

  std::string kind() const override { return "ROS 2 bag (SQLite)"; }
  const std::vector<RecordedTopic>& topics() const override { return topics_; }
  std::string missing() const override { return missing_; }
  void select(const MessageSelection& selection) override;
  std::optional<RecordedMessage> next() override;

 private:
  void check_magic();
  void read_topics();
  void count_messages();
  Statement prepare(const std::string& sql) const;
  bool step(sqlite3_stmt* statement);
  std::optional<RecordedMessage> message(sqlite3_stmt* row, int64_t number);
  bool read_head(int64_t number);

  std::string path_;
  Database database_;
  std::vector<RecordedTopic> topics_;
  std::map<int64_t, size_t> topic_of_;  // by the id in the file
  std::string missing_;
  MessageSelection selection_;
  Statement numbers_{nullptr, sqlite3_finalize}, row_{nullptr, sqlite3_finalize},
      head_row_{nullptr, sqlite3_finalize};
  std::string bytes_;
};

void SqliteBag::check_magic() {
  RandomFile file(path_);
  const std::string head(file.read(0, 100));
  if (head.substr(0, 15) != "SQLite format 3")
    throw InputError(path_, head.empty() ? "is empty" : "is not a ROS 2 bag in SQLite", "give a recording");
  const auto big_endian = [&](size_t at, size_t bytes) {
    uint64_t value = 0;
    for (size_t i = at; i < std::min(head.size(), at + bytes); ++i) value = value << 8 | uint8_t(head[i]);
    return value;
  };
  const uint64_t page = big_endian(16, 2) == 1 ? 65536 : big_endian(16, 2);
  const uint64_t stated = page * big_endian(28, 4);
  if (file.size() < stated)
    missing_ = "cut off: the last " + with_commas(stated - file.size()) + " of its " + with_commas(stated) +
               " bytes are missing";
}

Statement SqliteBag::prepare(const std::string& sql) const {
  sqlite3_stmt* statement = nullptr;
  const int result = sqlite3_prepare_v2(database_.get(), sql.c_str(), -1, &statement, nullptr);
  if (result == SQLITE_OK) return {statement, sqlite3_finalize};
  throw InputError(
      path_, std::string("is not a ROS 2 bag that can be read (") + sqlite3_errmsg(database_.get()) + ")",
      missing_.empty() ? "give a recording" : missing_);
}

// False at the end, which is where a file was cut off. Throws DamagedPart where it is damaged otherwise.
bool SqliteBag::step(sqlite3_stmt* statement) {
  const int result = sqlite3_step(statement);
  if (result == SQLITE_ROW) return true;
  if (result == SQLITE_DONE || !missing_.empty()) return false;
  numbers_.reset();
  throw DamagedPart(path_, std::string("is damaged (") + sqlite3_errmsg(database_.get()) + ")",
                    "it is read up to there");
}

void SqliteBag::read_topics() {
  const Statement rows = prepare("SELECT id, name, type, serialization_format FROM topics ORDER BY name, id");
  while (step(rows.get())) {
    RecordedTopic topic;
    topic.name = text_in(rows.get(), 1);
    topic.type = ros1_type(text_in(rows.get(), 2));
    topic.encoding = text_in(rows.get(), 3);
    topic.serialization = topic.encoding == "cdr" ? Serialization::kCdr : Serialization::kOther;
    topic_of_[sqlite3_column_int64(rows.get(), 0)] = topics_.size();
    topics_.push_back(topic);
  }
  if (topics_.empty() && !missing_.empty())
    throw InputError(path_, "nothing whole in it: " + missing_, "record again, or look for a copy");
}

// Counting reads the first page of each message: not of files of many gigabytes.
void SqliteBag::count_messages() try {
  constexpr uint64_t kMaxCounted = uint64_t(1) << 30;  // bytes
  if (std::filesystem::file_size(path_) > kMaxCounted) return;
  const Statement rows = prepare("SELECT topic_id, COUNT(*) FROM messages GROUP BY topic_id");
  for (RecordedTopic& topic : topics_) topic.messages = 0;
  while (step(rows.get()))
    if (const auto topic = topic_of_.find(sqlite3_column_int64(rows.get(), 0)); topic != topic_of_.end())
      topics_[topic->second].messages = sqlite3_column_int64(rows.get(), 1);
} catch (const DamagedPart&) {
  missing_ = "damaged: all messages before the damage are read";
  for (RecordedTopic& topic : topics_) topic.messages.reset();
}

// Numbers first, since SQLite would sort the messages themselves where the file has no index of times.
void SqliteBag::select(const MessageSelection& selection) {
  selection_ = selection;
  std::string ids;
  for (const auto& [id, topic] : topic_of_)
    if (std::count(selection.topics.begin(), selection.topics.end(), topic) > 0)
      ids += (ids.empty() ? "" : ",") + std::to_string(id);
  const bool whole = missing_.empty();
  numbers_ = prepare(std::string("SELECT id FROM messages ") + (whole ? "" : "NOT INDEXED ") +
                     "WHERE topic_id IN (" + ids + ") ORDER BY " + (whole ? "timestamp, id" : "id"));
  row_ = prepare("SELECT topic_id, timestamp, data FROM messages WHERE id = ?");
  head_row_ = prepare("SELECT topic_id, timestamp FROM messages WHERE id = ?");
}

std::optional<RecordedMessage> SqliteBag::next() {
  if (!numbers_) return std::nullopt;
  if (!step(numbers_.get())) {
    numbers_.reset();
    return std::nullopt;
  }
  const int64_t number = sqlite3_column_int64(numbers_.get(), 0);
  if (selection_.head_bytes == SIZE_MAX) return message(row_.get(), number);
  if (auto head = message(head_row_.get(), number)) {
    if (!read_head(number) || is_zstd(bytes_)) return message(row_.get(), number);
    head->bytes = bytes_;
    return head;
  }
  return std::nullopt;
}

std::optional<RecordedMessage> SqliteBag::message(sqlite3_stmt* row, int64_t number) {
  sqlite3_reset(row);
  sqlite3_bind_int64(row, 1, number);
  if (!step(row)) return std::nullopt;
  const auto topic = topic_of_.find(sqlite3_column_int64(row, 0));
  if (topic == topic_of_.end()) return std::nullopt;
  RecordedMessage message{topic->second, sqlite3_column_int64(row, 1), {}};
  if (sqlite3_column_count(row) < 3) return message;
  const auto* data = static_cast<const char*>(sqlite3_column_blob(row, 2));
  if (data) message.bytes = {data, size_t(sqlite3_column_bytes(row, 2))};
  if (is_zstd(message.bytes)) {
    unpack_zstd(message.bytes, selection_.head_bytes, path_ + ", message " + std::to_string(number), &bytes_);
    message.bytes = bytes_;
  }
  return message;
}

// The first bytes of a message as stored, without its other pages. False for one that is not stored as bytes.
bool SqliteBag::read_head(int64_t number) {
  sqlite3_blob* opened = nullptr;
  const int result = sqlite3_blob_open(database_.get(), "main", "messages", "data", number, 0, &opened);
  const std::unique_ptr<sqlite3_blob, int (*)(sqlite3_blob*)> blob(opened, sqlite3_blob_close);
  if (result != SQLITE_OK) return false;
  bytes_.resize(std::min(size_t(sqlite3_blob_bytes(opened)), selection_.head_bytes));
  return sqlite3_blob_read(opened, bytes_.data(), int(bytes_.size()), 0) == SQLITE_OK;
}

}  // namespace

std::unique_ptr<Recording> open_sqlite_bag(const std::string& path) {
  return std::make_unique<SqliteBag>(path);
}

}  // namespace edgevo
