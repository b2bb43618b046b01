// SPDX-License-Identifier: BSD-3-Clause
#include "map_file.h"

#include <filesystem>

namespace edgevo {

namespace fs = std::filesystem;

std::string name_while_made(const std::string& path) { return path + ".new"; }

void remove_map_files(const std::string& path) {
  std::error_code ignored;
  for (const char* end : {"", "-wal", "-shm"}) fs::remove(path + end, ignored);
}

void take_its_name(const std::string& path) {
  std::error_code error;
  fs::rename(name_while_made(path), path, error);
  if (error) throw InputError(path, "cannot be replaced: " + error.message(), "see " + name_while_made(path));
}

}  // namespace edgevo
