// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "edgevo/core/bad_frame.h"
#include "edgevo/core/input_decision.h"
#include "edgevo/datasets/describe.h"
#include "edgevo/datasets/open_source.h"

namespace edgevo {

std::vector<std::pair<std::string, std::string>> source_notices(const ImageSource& source) {
  std::vector<std::pair<std::string, std::string>> notices;
  for (const auto& detail : source.details())
    if (detail.first == kScaled) notices.push_back(detail);
  return notices;
}

std::vector<std::string> decision_lines(const std::string& path,
                                        const std::vector<InputDecision>& decisions) {
  std::vector<std::string> lines;
  for (const InputDecision& decision : decisions)
    lines.push_back("edgevo: " + path + ": " + to_string(decision));
  for (const std::string& warning : input_warnings(decisions)) lines.push_back("WARNING: " + warning);
  return lines;
}

std::vector<std::string> opening_lines(const std::string& path, const ImageSource& source) {
  std::vector<std::string> lines;
  for (const auto& [name, value] : source_notices(source))
    lines.push_back("edgevo: " + path + ": " + name + " " + value);
  for (std::string& line : decision_lines(path, source.decisions())) lines.push_back(std::move(line));
  return lines;
}

std::vector<std::string> find_bad_frames(ImageSource& source, const std::function<void(int)>& on_frame,
                                         int* frames) {
  std::vector<std::string> bad;
  for (bool more = true; more;) {
    try {
      more = source.next().has_value();
    } catch (const BadFrame& e) {
      bad.emplace_back(e.what());
    }
    if (more) on_frame(++*frames);
  }
  return bad;
}

bool names_camera_file(const std::string& path) {
  static const std::vector<std::string> kEndings{".yaml", ".yml", ".txt", ".json", ".ini",
                                                 ".xml",  ".cfg", ".bin", ".db"};
  std::error_code ignored;
  const std::string ending = std::filesystem::path(path).extension().string();
  return std::filesystem::is_regular_file(path, ignored) &&
         std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

}  // namespace edgevo
