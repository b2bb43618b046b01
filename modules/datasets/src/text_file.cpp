// SPDX-License-Identifier: BSD-3-Clause
#include "text_file.h"

#include <charconv>
#include <cmath>
#include <sstream>

#include "edgevo/core/error.h"
#include "edgevo/core/input_file.h"

namespace edgevo {
namespace {

constexpr const char* kBlanks = " \t\r\f\v";  // std::isspace less the end of a line

std::string_view trim(std::string_view text) {
  const size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kBlanks) - begin + 1);
}

}  // namespace

std::string quote(std::string_view text) {
  std::string result = "'";
  for (const unsigned char c : text.substr(0, 40)) result += c >= 0x20 && c < 0x7f ? char(c) : '?';
  return result + (text.size() > 40 ? "...'" : "'");
}

std::string read_text_file(const std::string& path) { return read_text(path, "check the path"); }

std::vector<TextLine> split_lines(const std::string& text, const std::string& path) {
  std::vector<TextLine> lines;
  std::istringstream in(text);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::string_view content = trim(line);
    if (content.empty() || content.front() == '#') continue;
    lines.push_back({std::string(content), path + ", line " + std::to_string(number)});
  }
  return lines;
}

std::vector<std::string> split_fields(std::string_view text, char separator) {
  std::vector<std::string> fields;
  if (separator != ' ') {
    for (size_t end = 0; end != std::string_view::npos;
         text.remove_prefix(end == std::string_view::npos ? 0 : end + 1)) {
      end = text.find(separator);
      fields.emplace_back(trim(text.substr(0, end)));
    }
    return fields;
  }
  while (true) {
    const size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return fields;
    text.remove_prefix(begin);
    const size_t length = std::min(text.find_first_of(kBlanks), text.size());
    fields.emplace_back(text.substr(0, length));
    text.remove_prefix(length);
  }
}

double parse_number(const std::string& text, const std::string& where) {
  double value = 0;
  const char* begin = text.data() + (text.size() > 1 && text[0] == '+' ? 1 : 0);
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end)
    throw InputError(where, quote(text) + " is not a number", "correct it");
  if (!std::isfinite(value)) throw InputError(where, quote(text) + " is not a finite number", "correct it");
  return value;
}

std::vector<double> parse_numbers(const TextLine& line, size_t count, const std::string& meaning) {
  const auto fields = split_fields(line.text);
  if (fields.size() != count)
    throw InputError(line.where,
                     "has " + std::to_string(fields.size()) + " fields instead of " + std::to_string(count),
                     "write " + meaning);
  std::vector<double> values;
  for (const std::string& field : fields) values.push_back(parse_number(field, line.where));
  return values;
}

Timestamp parse_nanoseconds(const std::string& text, const std::string& where) {
  int64_t ns = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), ns);
  constexpr int64_t kLargest = INT64_MAX - 100;  // rounding to a tick of 100 ns must not overflow
  if (error != std::errc() || stop != text.data() + text.size() || ns < 0 || ns > kLargest)
    throw InputError(where, "does not begin with a time in whole nanoseconds", "restore the file");
  return Timestamp::from_nanoseconds(ns);
}

}  // namespace edgevo
