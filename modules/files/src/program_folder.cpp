#include "edgevo/files/program_folder.h"

namespace edgevo {

std::filesystem::path program_folder() {
  std::error_code unknown;
  return std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
}

std::filesystem::path data_folder() { return data_folder_of(program_folder()); }

std::filesystem::path data_folder_of(const std::filesystem::path& folder) {
  std::error_code ignored;
  for (std::filesystem::path above = folder; above.has_relative_path();) {
    above = above.parent_path();
    if (std::filesystem::is_directory(above / "share/edgevo", ignored)) return above / "share/edgevo";
  }
  return folder.parent_path() / "share/edgevo";
}

}  // namespace edgevo
