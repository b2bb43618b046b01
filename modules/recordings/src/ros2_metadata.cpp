// SPDX-License-Identifier: BSD-3-Clause
#include "ros2_metadata.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kRoot = "rosbag2_bagfile_information";

std::string_view trimmed(std::string_view text, std::string_view characters = " \t\r") {
  const size_t first = text.find_first_not_of(characters);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(characters) - first + 1);
}

// One line: "KEY: VALUE", "- VALUE" or "- KEY: VALUE".
struct Line {
  bool is_item = false;
  std::string key, value;
};

Line parse_line(std::string_view text) {
  Line line;
  text = trimmed(text);
  line.is_item = text.substr(0, 2) == "- ";
  if (line.is_item) text = trimmed(text.substr(2));
  const size_t colon = text.find(": ");
  const bool opens = !text.empty() && text.back() == ':';
  if (colon != std::string_view::npos || opens) {
    line.key = text.substr(0, colon == std::string_view::npos ? text.size() - 1 : colon);
    text = opens && colon == std::string_view::npos ? std::string_view() : text.substr(colon + 1);
  }
  line.value = trimmed(trimmed(text), "'\"");
  return line;
}

class MetadataParser {
 public:
  void add(const Line& line) {
    if (!line.key.empty()) list_ = line.key;
    if (line.is_item && line.key.empty() && list_ == "relative_file_paths")
      metadata_.files.push_back(line.value);
    if (line.key == "compression_mode")
      metadata_.has_packed_messages = line.value == "MESSAGE" || line.value == "message";
    if (line.key == "name" && !topic_is_named_) topic_ = line.value, topic_is_named_ = true;
    if (line.key == "message_count" && topic_is_named_) {
      int64_t count = 0;
      std::from_chars(line.value.data(), line.value.data() + line.value.size(), count);
      metadata_.messages[topic_] = count;
      topic_is_named_ = false;
    }
  }
  Ros2Metadata metadata() const { return metadata_; }

 private:
  Ros2Metadata metadata_;
  std::string list_, topic_;
  bool topic_is_named_ = false;
};

bool is_recorded_file(const fs::path& path) {
  const fs::path inner = path.extension() == ".zstd" ? path.stem() : path;
  return inner.extension() == ".db3" || inner.extension() == ".mcap";
}

// The number at the end of a name: 12 of "drive_12.db3.zstd".
int number_of(const fs::path& path) {
  const std::string name = path.filename().string();
  const size_t dot = name.find('.');
  const std::string stem = name.substr(0, dot);
  const size_t last = stem.find_last_not_of("0123456789");
  const char* const begin = stem.data() + (last == std::string::npos ? 0 : last + 1);
  int number = -1;
  std::from_chars(begin, stem.data() + stem.size(), number);
  return number;
}

}  // namespace

Ros2Metadata parse_ros2_metadata(const std::string& text, const std::string& where) {
  if (text.find(kRoot) == std::string::npos)
    throw InputError(where, "is not of a ROS 2 bag", std::string("it should begin with ") + kRoot);
  MetadataParser parser;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    parser.add(parse_line(std::string_view(text).substr(begin, end - begin)));
    begin = end + 1;
  }
  const Ros2Metadata metadata = parser.metadata();
  if (metadata.files.empty())
    throw InputError(where, "names no files (relative_file_paths)", "give the .db3 or .mcap file itself");
  return metadata;
}

std::vector<std::string> recorded_files(const std::string& folder) {
  std::vector<fs::path> paths;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (is_recorded_file(entry.path())) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end(), [](const fs::path& a, const fs::path& b) {
    return std::make_pair(number_of(a), a.string()) < std::make_pair(number_of(b), b.string());
  });
  std::vector<std::string> names;
  for (const fs::path& path : paths) names.push_back(path.filename().string());
  return names;
}

bool has_ros2_metadata(const std::string& folder) {
  std::ifstream file(fs::path(folder) / "metadata.yaml", std::ios::binary);
  std::string begin(4096, '\0');
  file.read(begin.data(), std::streamsize(begin.size()));
  return begin.find(kRoot) != std::string::npos;
}

}  // namespace edgevo
