#pragma once
// The part of YAML that parameter files use, read strictly: nested `key: value` lines, indented with blanks, with comments
// and quoted texts. Everything else (lists, { } maps, anchors, tags, several documents) is an error with its line number.
//
// An own reader of this part, because MRPT's (mrpt::containers::yaml, on libfyaml) accepts broken documents as far as
// they make sense, lets the last of two equal keys win, prints to stderr, and keeps no line numbers.
#include <string>
#include <string_view>
#include <vector>

namespace edgevo {

/// One line with a key.
struct YamlEntry {
  std::string key;        ///< dotted: "mapping.window"
  std::string value;      ///< without quotes; empty for a key that stands alone
  bool has_value = true;  ///< false: "key:" alone, which opens a group (or forgot its value)
  int line = 0;           ///< from 1
};

/// The entries in the order of the text. Throws InputError "WHERE:LINE: ...".
std::vector<YamlEntry> parse_block_yaml(std::string_view text, const std::string& where);

/// `text` as a YAML scalar that parse_block_yaml and any other YAML reader give back as the same text: quoted if need be.
std::string yaml_scalar(const std::string& text);

}  // namespace edgevo
