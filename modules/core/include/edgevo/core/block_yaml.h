// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Strict reader of the part of YAML that parameter files use: nested `key: value` lines, indented with
// blanks, with comments and quoted texts. Everything else (lists, { } maps, anchors, tags, several documents)
// is an error with its line number.
//
// MRPT's reader (mrpt::containers::yaml, on libfyaml) is not used for this: it accepts broken documents as
// far as they make sense, lets the last of two equal keys win, prints to stderr, and keeps no line numbers.
#include <string>
#include <string_view>
#include <vector>

namespace edgevo {

/// One line with a key.
struct YamlEntry {
  /// Dotted path of the key: "mapping.window".
  std::string key;
  /// Value without quotes; empty for a key without a value.
  std::string value;
  /// False for a bare "key:", which opens a group (or lacks its value).
  bool has_value = true;
  /// Line number, from 1.
  int line = 0;
};

/// Entries of `text` in order. Throws InputError "WHERE:LINE: ...".
std::vector<YamlEntry> parse_block_yaml(std::string_view text, const std::string& where);

/// `text` as a YAML scalar, quoted if necessary, that parse_block_yaml and any other YAML reader turn back
/// into the same text.
std::string yaml_scalar(const std::string& text);

}  // namespace edgevo
