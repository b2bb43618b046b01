// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Texts of a file in messages, which have one line.
#include <string>
#include <string_view>

namespace edgevo {

/// The text with a question mark for each control character.
inline std::string printable(std::string_view text) {
  constexpr unsigned char kFirst = ' ', kDelete = 127;
  std::string printed(text);
  for (char& c : printed)
    if (static_cast<unsigned char>(c) < kFirst || static_cast<unsigned char>(c) == kDelete) c = '?';
  return printed;
}

}  // namespace edgevo
