// SPDX-License-Identifier: BSD-3-Clause
#include "one_line.h"

namespace edgevo {

std::string one_line(const std::exception& error) {
  std::string text = error.what();
  // "Message:  TEXT" below "=== MRPT EXCEPTION ===", or the text alone.
  const std::string label = "Message:";
  if (const size_t at = text.find(label); at != std::string::npos) text.erase(0, at + label.size());
  text.erase(0, text.find_first_not_of(" \t\r\n"));
  return text.substr(0, text.find_first_of("\r\n"));
}

}  // namespace edgevo
