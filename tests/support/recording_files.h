// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Recordings as ROS writes them, from messages; shares nothing with what reads them. The programs that use it
// link zlib, bz2, lz4, zstd and sqlite3.
#include <bzlib.h>
#include <lz4frame.h>
#include <sqlite3.h>
#include <zlib.h>
#include <zstd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace edgevo::test {

/// A topic; its type as ROS 1 names it.
struct TestTopic {
  std::string name, type;
};
/// A message of topics[topic].
struct TestMessage {
  size_t topic = 0;
  int64_t ns = 0;
  std::string bytes;
};

inline std::string packed(const std::string& compression, const std::string& bytes) {
  std::string out(bytes.size() + bytes.size() / 50 + 70000, '\0');
  if (compression == "bz2") {
    unsigned size = unsigned(out.size());
    BZ2_bzBuffToBuffCompress(out.data(), &size, const_cast<char*>(bytes.data()), unsigned(bytes.size()), 9, 0,
                             0);
    out.resize(size);
  } else if (compression == "lz4") {
    LZ4F_preferences_t preferences{};
    preferences.frameInfo.contentChecksumFlag = LZ4F_contentChecksumEnabled;
    out.resize(LZ4F_compressFrame(out.data(), out.size(), bytes.data(), bytes.size(), &preferences));
  } else if (compression == "zstd") {
    out.resize(ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), 3));
  } else {
    out = bytes;
  }
  return out;
}

template <class T>
std::string little(T value) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return bytes;
}

inline std::string with_length(const std::string& bytes) { return little(uint32_t(bytes.size())) + bytes; }

/// A record of a ROS 1 bag.
inline std::string bag_record(const std::vector<std::pair<std::string, std::string>>& fields,
                              const std::string& data) {
  std::string header;
  for (const auto& [name, value] : fields) header += with_length(name + "=" + value);
  return with_length(header) + with_length(data);
}

inline std::string bag_time(int64_t ns) {
  return little(uint32_t(ns / 1'000'000'000)) + little(uint32_t(ns % 1'000'000'000));
}

inline std::string bag_connection(const std::vector<TestTopic>& topics, size_t i) {
  const std::string data = with_length("topic=" + topics[i].name) + with_length("type=" + topics[i].type) +
                           with_length("md5sum=*") + with_length("message_definition=\n");
  return bag_record({{"op", "\x07"}, {"conn", little(uint32_t(i))}, {"topic", topics[i].name}}, data);
}

/// A ROS 1 bag; `compression`: none, bz2, lz4; a chunk ends after `chunk_bytes`. Not closed: as a recorder
/// that was killed leaves it, without index.
inline std::string ros1_bag(const std::vector<TestTopic>& topics, const std::vector<TestMessage>& messages,
                            const std::string& compression = "none", size_t chunk_bytes = 4096,
                            bool is_closed = true) {
  const auto head = [](uint64_t index, uint32_t connections, uint32_t chunks) {
    const std::vector<std::pair<std::string, std::string>> fields{{"op", "\x03"},
                                                                  {"index_pos", little(index)},
                                                                  {"conn_count", little(connections)},
                                                                  {"chunk_count", little(chunks)}};
    const size_t used = bag_record(fields, "").size();
    return "#ROSBAG V2.0\n" + bag_record(fields, std::string(4096 - used, ' '));
  };
  std::string body, infos;
  uint32_t chunks = 0;
  std::map<size_t, bool> known;
  for (size_t i = 0; i < messages.size(); ++chunks) {
    std::string chunk;
    std::map<size_t, std::string> index;
    const int64_t begin = messages[i].ns;
    int64_t end = begin;
    for (; i < messages.size() && chunk.size() < chunk_bytes; ++i) {
      const TestMessage& m = messages[i];
      if (!known[m.topic]) chunk += bag_connection(topics, m.topic), known[m.topic] = true;
      index[m.topic] += bag_time(m.ns) + little(uint32_t(chunk.size()));
      chunk += bag_record({{"op", "\x02"}, {"conn", little(uint32_t(m.topic))}, {"time", bag_time(m.ns)}},
                          m.bytes);
      end = m.ns;
    }
    const uint64_t at = head(0, 0, 0).size() + body.size();
    body +=
        bag_record({{"op", "\x05"}, {"compression", compression}, {"size", little(uint32_t(chunk.size()))}},
                   packed(compression, chunk));
    std::string counts;
    for (const auto& [topic, entries] : index) {
      const std::string count = little(uint32_t(entries.size() / 12));
      body += bag_record(
          {{"op", "\x04"}, {"ver", little(1)}, {"conn", little(uint32_t(topic))}, {"count", count}}, entries);
      counts += little(uint32_t(topic)) + count;
    }
    infos += bag_record({{"op", "\x06"},
                         {"ver", little(1)},
                         {"chunk_pos", little(at)},
                         {"start_time", bag_time(begin)},
                         {"end_time", bag_time(end)},
                         {"count", little(uint32_t(index.size()))}},
                        counts);
  }
  if (!is_closed) return head(0, 0, 0) + body;
  const uint64_t index = head(0, 0, 0).size() + body.size();
  std::string connections;
  for (size_t i = 0; i < topics.size(); ++i)
    if (known[i]) connections += bag_connection(topics, i);
  return head(index, uint32_t(topics.size()), chunks) + body + connections + infos;
}

/// How an MCAP file is written.
struct McapOptions {
  std::string compression;  // "", lz4, zstd
  bool has_chunks = true, has_message_index = true, has_summary = true, has_crc = true, is_closed = true;
  bool is_ros1 = false;
  size_t chunk_bytes = 4096;
};

inline std::string mcap_record(uint8_t op, const std::string& contents) {
  return std::string(1, char(op)) + little(uint64_t(contents.size())) + contents;
}

inline uint32_t crc_of(const std::string& bytes) {
  return uint32_t(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

/// "sensor_msgs/Image" as ROS 2 names it.
inline std::string ros2_type(const std::string& type) {
  return type.substr(0, type.find('/')) + "/msg" + type.substr(type.find('/'));
}

inline std::string mcap_definitions(const std::vector<TestTopic>& topics, bool is_ros1) {
  std::string records;
  for (size_t i = 0; i < topics.size(); ++i) {
    const std::string id = little(uint16_t(i + 1));
    const std::string type = is_ros1 ? topics[i].type : ros2_type(topics[i].type);
    records += mcap_record(
        3, id + with_length(type) + with_length(is_ros1 ? "ros1msg" : "ros2msg") + with_length("# none"));
    records += mcap_record(4, id + id + with_length(topics[i].name) + with_length(is_ros1 ? "ros1" : "cdr") +
                                  with_length(with_length("a") + with_length("b")));
  }
  return records;
}

/// An MCAP file.
inline std::string mcap_file(const std::vector<TestTopic>& topics, const std::vector<TestMessage>& messages,
                             const McapOptions& o = {}) {
  const std::string magic("\x89MCAP0\r\n", 8);
  const std::string definitions = mcap_definitions(topics, o.is_ros1);
  std::string file = magic + mcap_record(1, with_length(o.is_ros1 ? "ros1" : "ros2") + with_length("test"));
  std::string chunk_indices;
  std::map<uint16_t, uint64_t> counts;
  uint32_t chunks = 0;
  if (!o.has_chunks) file += definitions;
  for (size_t i = 0; i < messages.size();) {
    std::string chunk = o.has_chunks && chunks == 0 ? definitions : "";
    std::map<uint16_t, std::string> index;
    const int64_t begin = messages[i].ns;
    int64_t end = begin;
    for (; i < messages.size() && chunk.size() < o.chunk_bytes; ++i) {
      const TestMessage& m = messages[i];
      const auto channel = uint16_t(m.topic + 1);
      index[channel] += little(m.ns) + little(uint64_t(chunk.size()));
      chunk += mcap_record(5, little(channel) + little(uint32_t(i)) + little(m.ns) + little(m.ns) + m.bytes);
      ++counts[channel];
      end = m.ns;
    }
    if (!o.has_chunks) {
      file += chunk;
      continue;
    }
    ++chunks;
    const std::string data = packed(o.compression, chunk);
    const std::string record =
        mcap_record(6, little(begin) + little(end) + little(uint64_t(chunk.size())) +
                           little(o.has_crc ? crc_of(chunk) : 0u) + with_length(o.compression) +
                           little(uint64_t(data.size())) + data);
    const uint64_t at = file.size();
    file += record;
    std::string places;
    const uint64_t index_at = file.size();
    for (const auto& [channel, entries] : index) {
      if (!o.has_message_index) break;
      places += little(channel) + little(uint64_t(file.size()));
      file += mcap_record(7, little(channel) + with_length(entries));
    }
    chunk_indices += mcap_record(
        8, little(begin) + little(end) + little(at) + little(uint64_t(record.size())) + with_length(places) +
               little(uint64_t(file.size() - index_at)) + with_length(o.compression) +
               little(uint64_t(data.size())) + little(uint64_t(chunk.size())));
  }
  if (!o.is_closed) return file;
  file += mcap_record(15, little(0u));
  const uint64_t summary_at = o.has_summary ? file.size() : 0;
  if (o.has_summary) {
    std::string count_map;
    for (const auto& [channel, count] : counts) count_map += little(channel) + little(count);
    const std::string times = little(messages.empty() ? 0 : messages.front().ns) +
                              little(messages.empty() ? 0 : messages.back().ns);
    file += definitions + (o.has_chunks ? chunk_indices : "") +
            mcap_record(11, little(uint64_t(messages.size())) + little(uint16_t(topics.size())) +
                                little(uint32_t(topics.size())) + little(0u) + little(0u) + little(chunks) +
                                times + with_length(count_map));
  }
  std::string footer =
      std::string(1, '\x02') + little(uint64_t(20)) + little(summary_at) + little(uint64_t(0));
  const uint32_t crc = o.has_crc && o.has_summary ? crc_of(file.substr(summary_at) + footer) : 0;
  return file + footer + little(crc) + magic;
}

/// Writes a file of a ROS 2 bag in SQLite; `compression`: "" or zstd, message by message.
inline void write_db3(const std::string& path, const std::vector<TestTopic>& topics,
                      const std::vector<TestMessage>& messages, const std::string& compression = "") {
  std::filesystem::remove(path);
  sqlite3* db = nullptr;
  sqlite3_open(path.c_str(), &db);
  const auto run = [&](const char* sql) { sqlite3_exec(db, sql, nullptr, nullptr, nullptr); };
  const auto insert = [&](const char* sql, const std::function<void(sqlite3_stmt*)>& bind) {
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(db, sql, -1, &statement, nullptr);
    bind(statement);
    sqlite3_step(statement);
    sqlite3_finalize(statement);
  };
  const auto text = [](sqlite3_stmt* s, int i, const std::string& t) {
    sqlite3_bind_text(s, i, t.data(), int(t.size()), SQLITE_TRANSIENT);
  };
  run("CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,serialization_format "
      "TEXT NOT NULL,"
      "offered_qos_profiles TEXT NOT NULL)");
  run("CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,timestamp INTEGER NOT NULL, "
      "data BLOB NOT NULL)");
  run("CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
  run("BEGIN");
  for (const TestTopic& topic : topics)
    insert("INSERT INTO topics(name,type,serialization_format,offered_qos_profiles) VALUES(?,?,'cdr','')",
           [&](sqlite3_stmt* s) { text(s, 1, topic.name), text(s, 2, ros2_type(topic.type)); });
  for (const TestMessage& m : messages)
    insert("INSERT INTO messages(topic_id,timestamp,data) VALUES(?,?,?)", [&](sqlite3_stmt* s) {
      const std::string data = packed(compression, m.bytes);
      sqlite3_bind_int64(s, 1, int64_t(m.topic + 1)), sqlite3_bind_int64(s, 2, m.ns);
      sqlite3_bind_blob(s, 3, data.data(), int(data.size()), SQLITE_TRANSIENT);
    });
  run("COMMIT");
  sqlite3_close(db);
}

/// metadata.yaml of a ROS 2 bag as its version 5 writes it.
inline std::string ros2_metadata(const std::vector<std::string>& files, const std::vector<TestTopic>& topics,
                                 const std::vector<TestMessage>& messages, const std::string& storage,
                                 const std::string& mode = "") {
  std::string text = "rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: " + storage +
                     "\n  duration:\n    nanoseconds: 1\n  starting_time:\n    nanoseconds_since_epoch: 1\n  "
                     "message_count: " +
                     std::to_string(messages.size()) + "\n  topics_with_message_count:\n";
  for (size_t i = 0; i < topics.size(); ++i) {
    size_t count = 0;
    for (const TestMessage& m : messages) count += m.topic == i;
    text +=
        "    - topic_metadata:\n        name: " + topics[i].name +
        "\n        type: " + ros2_type(topics[i].type) +
        "\n        serialization_format: cdr\n        offered_qos_profiles: \"- history: 3\\n  depth: 0\"\n"
        "      message_count: " +
        std::to_string(count) + "\n";
  }
  text += "  compression_format: " + std::string(mode.empty() ? "\"\"" : "zstd") +
          "\n  compression_mode: " + (mode.empty() ? "\"\"" : mode) + "\n  relative_file_paths:\n";
  for (const std::string& file : files) text += "    - " + file + "\n";
  return text + "  files:\n    - path: " + files.front() + "\n      message_count: 3\n";
}

}  // namespace edgevo::test
