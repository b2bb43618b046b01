// SPDX-License-Identifier: BSD-3-Clause
// Mutated recordings of ROS: opened, listed, read to the end, every message decoded. EDGEVO_FUZZ_ROUNDS sets
// the number of mutations of each kind of file, for runs under a sanitizer.
#include <cstdlib>

#include "edgevo/recordings/image_pixels.h"
#include "edgevo/recordings/static_frames.h"
#include "fuzz/mutate.h"
#include "ros2_metadata.h"
#include "unit/recordings/made_recording.h"

namespace edgevo::test {
namespace {

int rounds(int usual) {
  const char* const text = std::getenv("EDGEVO_FUZZ_ROUNDS");
  return text ? std::atoi(text) : usual;
}

void decode(const RecordedTopic& topic, std::string_view bytes, StaticFrames* frames) {
  const Serialization s = topic.serialization;
  if (topic.type == "sensor_msgs/Image") gray_image(decode_image(bytes, s, "m"), "m");
  if (topic.type == "sensor_msgs/CompressedImage") decode_compressed_image(bytes, s, "m");
  if (topic.type == "sensor_msgs/CameraInfo") decode_camera_info(bytes, s, "m");
  if (topic.type == "nav_msgs/Odometry") decode_odometry(bytes, s, "m");
  if (topic.type == "sensor_msgs/NavSatFix") decode_nav_sat_fix(bytes, s, "m");
  if (topic.type == "sensor_msgs/Imu") decode_imu(bytes, s, "m");
  if (topic.type == "geometry_msgs/PoseStamped") decode_pose(bytes, s, "m");
  if (topic.type != "tf2_msgs/TFMessage") return;
  for (const TransformMessage& t : decode_transforms(bytes, s, "m")) frames->add(t);
  frames->between(frames->vehicle_frame("cam0_optical"), "cam0_optical");
}

// Reads on behind damage; throws the first.
void read_to_the_end(Recording* recording) {
  constexpr int kMaxMessages = 10000;
  StaticFrames frames;
  MessageSelection selection;
  for (size_t i = 0; i < recording->topics().size(); ++i) selection.topics.push_back(i);
  recording->select(selection);
  std::optional<InputError> damage;
  int messages = 0;
  for (bool more = true; more && messages < kMaxMessages; ++messages) try {
      const auto message = recording->next();
      more = message.has_value();
      if (more) decode(recording->topics().at(message->topic), message->bytes, &frames);
    } catch (const InputError& e) {
      if (!damage) damage = e;
    }
  EXPECT_LT(messages, kMaxMessages) << "endless";
  if (damage) throw *damage;
}

// All types of messages, a few of each.
MadeRecording made_of_all(Wire wire) {
  MadeRecording made = made_recording(wire, 2);
  const std::vector<std::pair<TestTopic, std::string>> others{
      {{"/c", "sensor_msgs/CompressedImage"}, compressed_message(wire, kStartNs, "jpeg", "a file")},
      {{"/i", "sensor_msgs/CameraInfo"}, camera_info_message(wire, kStartNs, {})},
      {{"/f", "sensor_msgs/NavSatFix"}, nav_sat_fix_message(wire, kStartNs, 0, {1, 2, 3})},
      {{"/u", "sensor_msgs/Imu"}, imu_message(wire, kStartNs, {0, 0, 0, 1})},
      {{"/p", "geometry_msgs/PoseStamped"}, pose_message(wire, kStartNs, {1, 2, 3}, {0, 0, 0, 1})}};
  for (const auto& [topic, bytes] : others) {
    made.topics.push_back(topic);
    made.messages.push_back({made.topics.size() - 1, kStartNs + 1'000'000'000, bytes});
  }
  return made;
}

void fuzz_bytes(const std::string& name, const std::string& valid, int usual, uint64_t seed) {
  const TempFolder folder;
  const std::string path = folder / name;
  expect_both(fuzz(valid, rounds(usual), seed, [&](const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    read_to_the_end(open_recording(path).get());
  }));
}

TEST(FuzzRecordings, Bag) {
  constexpr int kRounds = 500;
  const MadeRecording made = made_of_all(Wire::kRos1);
  fuzz_bytes("x.bag", ros1_bag(made.topics, made.messages, "none", 1000), kRounds, 601);
  fuzz_bytes("x.bag", ros1_bag(made.topics, made.messages, "none", 1000, false), kRounds, 602);
  fuzz_bytes("x.bag", ros1_bag(made.topics, made.messages, "lz4", 1000), kRounds, 603);
  fuzz_bytes("x.bag", ros1_bag(made.topics, made.messages, "bz2", 1000), kRounds, 604);
}

TEST(FuzzRecordings, Mcap) {
  constexpr int kRounds = 500;
  uint64_t seed = 610;
  for (const char* compression : {"", "lz4", "zstd"})
    for (const bool has_summary : {false, true}) {
      McapOptions options = mcap_options(compression, true, has_summary, has_summary);
      options.has_crc = false;
      const MadeRecording made = made_of_all(has_summary ? Wire::kCdrLittle : Wire::kCdrBig);
      fuzz_bytes("x.mcap", mcap_file(made.topics, made.messages, options), kRounds, ++seed);
    }
  const MadeRecording made = made_of_all(Wire::kCdrLittle);
  fuzz_bytes("x.mcap", mcap_file(made.topics, made.messages, mcap_options("", false)), kRounds, ++seed);
  fuzz_bytes("x.mcap", mcap_file(made.topics, made.messages, mcap_options("zstd")), kRounds, ++seed);
}

TEST(FuzzRecordings, Sqlite) {
  constexpr int kRounds = 500;
  const TempFolder folder;
  const MadeRecording made = made_of_all(Wire::kCdrLittle);
  write_db3(folder / "x.db3", made.topics, made.messages);
  fuzz_bytes("x.db3", content(folder / "x.db3"), kRounds, 630);
  write_db3(folder / "x.db3", made.topics, made.messages, "zstd");
  fuzz_bytes("x.db3", content(folder / "x.db3"), kRounds, 631);
  fuzz_bytes("x.db3.zstd", packed("zstd", content(folder / "x.db3")), kRounds, 632);
}

TEST(FuzzRecordings, Metadata) {
  constexpr int kRounds = 2000;
  const MadeRecording made = made_of_all(Wire::kCdrLittle);
  expect_both(fuzz(ros2_metadata({"x_0.db3", "x_1.db3"}, made.topics, made.messages, "sqlite3"),
                   rounds(kRounds), 640, [](const std::string& text) { parse_ros2_metadata(text, "f"); }));
}

}  // namespace
}  // namespace edgevo::test
