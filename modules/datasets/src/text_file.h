// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Strict line-by-line reading of text files, with the location of each line for messages.
#include <string>
#include <string_view>
#include <vector>

#include "edgevo/core/timestamp.h"

namespace edgevo {

struct TextLine {
  /// Text without comment and surrounding blanks; never empty.
  std::string text;
  /// Location of the line, "path, line 12".
  std::string where;
};

/// Reads the whole file, without a byte order mark. Throws InputError if it cannot be read.
std::string read_text_file(const std::string& path);

/// Lines that are not empty; a line that begins with # is a comment.
std::vector<TextLine> split_lines(const std::string& text, const std::string& path);

/// Fields separated by blanks, or by single `separator`s other than a blank (then trimmed, empty ones kept).
std::vector<std::string> split_fields(std::string_view text, char separator = ' ');

/// User input as quoted in a message: in quotes, short, printable, on one line.
std::string quote(std::string_view text);

/// A finite number, independent of the locale. Throws InputError, opened by `where`, that quotes the text.
double parse_number(const std::string& text, const std::string& where);

/// All fields of a line as numbers. Throws InputError unless there are exactly `count`.
std::vector<double> parse_numbers(const TextLine& line, size_t count, const std::string& meaning);

/// A time in whole nanoseconds. Throws InputError opened by `where`.
Timestamp parse_nanoseconds(const std::string& text, const std::string& where);

}  // namespace edgevo
