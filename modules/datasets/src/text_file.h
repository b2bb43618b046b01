#pragma once
// Text files line by line, strictly, with the place of each line at hand for messages.
#include <string>
#include <string_view>
#include <vector>

#include "edgevo/core/timestamp.h"

namespace edgevo {

struct TextLine {
  std::string text;   ///< without comment and surrounding blanks; never empty
  std::string where;  ///< "path, line 12"
};

/// The whole file. Throws InputError if it cannot be read.
std::string read_text_file(const std::string& path);

/// Lines that hold something; a line that begins with # is a comment.
std::vector<TextLine> split_lines(const std::string& text, const std::string& path);

/// Fields between blanks, or between single `separator`s when that is not a blank (then trimmed, empty ones
/// kept).
std::vector<std::string> split_fields(std::string_view text, char separator = ' ');

/// What a message may quote of the user's input: in quotes, short, printable, one line.
std::string quote(std::string_view text);

/// A finite number, whatever the locale. Throws InputError opened by `where` that quotes the text.
double parse_number(const std::string& text, const std::string& where);

/// All fields of a line as numbers. Throws InputError unless there are exactly `count`.
std::vector<double> parse_numbers(const TextLine& line, size_t count, const std::string& meaning);

/// A time in whole nanoseconds. Throws InputError opened by `where`.
Timestamp parse_nanoseconds(const std::string& text, const std::string& where);

}  // namespace edgevo
