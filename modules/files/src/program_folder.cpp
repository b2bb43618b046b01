// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/files/program_folder.h"

namespace edgevo {

std::filesystem::path program_folder() {
  std::error_code unknown;
  return std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
}

std::filesystem::path data_folder() { return data_folder_of(program_folder()); }

std::filesystem::path data_folder_of(const std::filesystem::path& folder) {
  constexpr int kLevels =
      3;  // PREFIX/libexec/edgevo and PREFIX/lib/TRIPLET/edgevo lie up to three below PREFIX
  std::error_code ignored;
  std::filesystem::path above = folder;
  for (int level = 0; level < kLevels && above.has_relative_path(); ++level) {
    above = above.parent_path();
    if (std::filesystem::is_directory(above / "share/edgevo", ignored)) return above / "share/edgevo";
  }
  return folder.parent_path() / "share/edgevo";
}

}  // namespace edgevo
