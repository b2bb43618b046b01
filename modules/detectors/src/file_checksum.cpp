// SPDX-License-Identifier: BSD-3-Clause
#include "file_checksum.h"

#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "edgevo/core/input_file.h"

namespace edgevo {

std::string file_checksum(const std::string& path) {
  const std::string bytes = read_file(path, "name a file that can be read");
  uint64_t hash = 14695981039346656037u;  // FNV-1a, 64 bits: offset and prime are part of its definition
  for (const char c : bytes) hash = (hash ^ uint8_t(c)) * 1099511628211u;
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return std::filesystem::path(path).filename().string() + ", " + std::to_string(bytes.size()) +
         " bytes, fnv1a " + digits;
}

}  // namespace edgevo
