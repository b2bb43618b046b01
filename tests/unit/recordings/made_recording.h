// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A small recording of a camera, wheels and static frames, in every kind of file.
#include <string>
#include <utility>
#include <vector>

#include "edgevo/recordings/messages.h"
#include "support/recording_files.h"
#include "support/recording_messages.h"
#include "support/temp_folder.h"
#include "support/text.h"

namespace edgevo::test {

constexpr int64_t kStartNs = 1'600'000'000'123'456'700;

/// Topics and messages in one serialization.
struct MadeRecording {
  std::vector<TestTopic> topics{{"/tf_static", "tf2_msgs/TFMessage"},
                                {"/cam0/image_raw", "sensor_msgs/Image"},
                                {"/odom", "nav_msgs/Odometry"}};
  std::vector<TestMessage> messages;
};

constexpr int kMadeImages = 9;

/// `count` images of 16 x 12 whose pixels begin with their number, ten a second, recorded 5 ms after their
/// stamps; two odometry messages an image.
inline MadeRecording made_recording(Wire wire, int count = kMadeImages) {
  MadeRecording made;
  made.messages.push_back(
      {0, kStartNs,
       transforms_message(wire, {{"/base_link", "cam0_optical", {1, 2, 3}, {-0.5, 0.5, -0.5, 0.5}}})});
  for (int i = 0; i < count; ++i) {
    TestImage image{16, 12, "mono8", std::string(16 * 12, char(i)), 16};
    for (size_t k = 1; k < image.data.size(); ++k) image.data[k] = char(7 * i + 31 * int(k));
    const int64_t stamp = kStartNs + i * int64_t(100'000'000);
    made.messages.push_back({1, stamp + 5'000'000, image_message(wire, stamp, image)});
    for (int k = 0; k < 2; ++k) {
      const int64_t at = stamp + 10'000'000 + k * int64_t(50'000'000);
      made.messages.push_back({2, at, odometry_message(wire, at, {i + 0.5 * k, 0, 0}, {0, 0, 0, 1})});
    }
  }
  return made;
}

/// A kind of file.
struct RecordingKind {
  std::string name;
  Wire wire;
  /// Writes the recording into the folder and returns its path.
  std::string (*write)(const TempFolder&, const MadeRecording&);
};

inline std::string write_bytes(const TempFolder& folder, const std::string& name, const std::string& bytes) {
  std::ofstream(folder / name, std::ios::binary) << bytes;
  return folder / name;
}

inline std::string write_mcap(const TempFolder& folder, const MadeRecording& made,
                              const McapOptions& options) {
  return write_bytes(folder, "x.mcap", mcap_file(made.topics, made.messages, options));
}

inline std::string write_bag(const TempFolder& folder, const MadeRecording& made,
                             const std::string& compression) {
  return write_bytes(folder, "x.bag", ros1_bag(made.topics, made.messages, compression, 1000));
}

// Files of a split recording with these parts of the messages.
inline std::vector<MadeRecording> split(const MadeRecording& made) {
  std::vector<MadeRecording> parts(2, made);
  const auto middle = made.messages.begin() + long(made.messages.size() / 2);
  parts[0].messages.assign(made.messages.begin(), middle);
  parts[1].messages.assign(middle, made.messages.end());
  return parts;
}

inline std::string write_split_db3(const TempFolder& folder, const MadeRecording& made,
                                   const std::string& mode) {
  std::filesystem::create_directories(folder / "ros2");
  std::vector<std::string> names;
  for (const MadeRecording& part : split(made)) {
    std::string name = "x_" + std::to_string(names.size()) + ".db3";
    write_db3(folder / ("ros2/" + name), part.topics, part.messages, mode == "MESSAGE" ? "zstd" : "");
    if (mode == "FILE") {
      const std::string whole = content(folder / ("ros2/" + name));
      std::filesystem::remove(folder / ("ros2/" + name));
      name += ".zstd";
      write_bytes(folder, "ros2/" + name, packed("zstd", whole));
    }
    names.push_back(name);
  }
  write_bytes(folder, "ros2/metadata.yaml",
              ros2_metadata(names, made.topics, made.messages, "sqlite3", mode));
  return folder / "ros2";
}

inline std::string write_mcap_folder(const TempFolder& folder, const MadeRecording& made) {
  std::filesystem::create_directories(folder / "ros2");
  std::vector<std::string> names;
  for (const MadeRecording& part : split(made)) {
    names.push_back("x_" + std::to_string(names.size()) + ".mcap");
    write_bytes(folder, "ros2/" + names.back(), mcap_file(part.topics, part.messages));
  }
  write_bytes(folder, "ros2/metadata.yaml", ros2_metadata(names, made.topics, made.messages, "mcap"));
  return folder / "ros2";
}

inline McapOptions mcap_options(const std::string& compression, bool chunks = true, bool index = true,
                                bool summary = true) {
  McapOptions options;
  options.compression = compression, options.chunk_bytes = 1000;
  options.has_chunks = chunks, options.has_message_index = index, options.has_summary = summary;
  return options;
}

/// Every kind of file that is read.
inline const std::vector<RecordingKind>& recording_kinds() {
  using F = const TempFolder&;
  using M = const MadeRecording&;
  static const std::vector<RecordingKind> kKinds{
      {"bag", Wire::kRos1, [](F f, M m) { return write_bag(f, m, "none"); }},
      {"bag bz2", Wire::kRos1, [](F f, M m) { return write_bag(f, m, "bz2"); }},
      {"bag lz4", Wire::kRos1, [](F f, M m) { return write_bag(f, m, "lz4"); }},
      {"mcap", Wire::kCdrLittle, [](F f, M m) { return write_mcap(f, m, mcap_options("")); }},
      {"mcap zstd", Wire::kCdrLittle, [](F f, M m) { return write_mcap(f, m, mcap_options("zstd")); }},
      {"mcap lz4", Wire::kCdrBig, [](F f, M m) { return write_mcap(f, m, mcap_options("lz4")); }},
      {"mcap ros1", Wire::kRos1,
       [](F f, M m) {
         McapOptions options = mcap_options("zstd");
         options.is_ros1 = true;
         return write_mcap(f, m, options);
       }},
      {"mcap without chunks", Wire::kCdrLittle,
       [](F f, M m) { return write_mcap(f, m, mcap_options("", false)); }},
      {"mcap without message index", Wire::kCdrLittle,
       [](F f, M m) { return write_mcap(f, m, mcap_options("lz4", true, false)); }},
      {"mcap without summary", Wire::kCdrLittle,
       [](F f, M m) { return write_mcap(f, m, mcap_options("zstd", true, true, false)); }},
      {"mcap without any index", Wire::kCdrLittle,
       [](F f, M m) { return write_mcap(f, m, mcap_options("", true, false, false)); }},
      {"db3", Wire::kCdrLittle,
       [](F f, M m) {
         write_db3(f / "x.db3", m.topics, m.messages);
         return f / "x.db3";
       }},
      {"db3 folder", Wire::kCdrLittle, [](F f, M m) { return write_split_db3(f, m, ""); }},
      {"db3 zstd messages", Wire::kCdrBig, [](F f, M m) { return write_split_db3(f, m, "MESSAGE"); }},
      {"db3 zstd files", Wire::kCdrLittle, [](F f, M m) { return write_split_db3(f, m, "FILE"); }},
      {"mcap folder", Wire::kCdrLittle, [](F f, M m) { return write_mcap_folder(f, m); }}};
  return kKinds;
}

inline size_t topic_named(const Recording& recording, const std::string& name) {
  for (size_t i = 0; i < recording.topics().size(); ++i)
    if (recording.topics()[i].name == name) return i;
  return SIZE_MAX;
}

/// Times and bytes of all messages of a topic, and of damaged parts 0 and what is wrong.
inline std::vector<std::pair<int64_t, std::string>> read_all(Recording* recording, const std::string& topic,
                                                             size_t head_bytes = SIZE_MAX) {
  std::vector<std::pair<int64_t, std::string>> messages;
  MessageSelection selection;
  selection.topics = {topic_named(*recording, topic)};
  selection.head_bytes = head_bytes;
  recording->select(selection);
  for (bool more = true; more;) try {
      const auto message = recording->next();
      more = message.has_value();
      if (more) messages.emplace_back(message->recorded_ns, message->bytes);
    } catch (const DamagedPart& e) {
      messages.emplace_back(0, e.what());
    }
  return messages;
}

/// The same as it was written.
inline std::vector<std::pair<int64_t, std::string>> written(const MadeRecording& made, size_t topic) {
  std::vector<std::pair<int64_t, std::string>> messages;
  for (const TestMessage& m : made.messages)
    if (m.topic == topic) messages.emplace_back(m.ns, m.bytes);
  return messages;
}

}  // namespace edgevo::test
