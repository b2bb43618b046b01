// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/files/program_folder.h"

#include <dlfcn.h>

namespace edgevo {
namespace {

// Folder of the shared library that this code is linked into, such as a module of Python, whose program is
// not ours; empty if it is the program itself.
std::filesystem::path library_folder() {
  Dl_info found;
  if (dladdr(reinterpret_cast<void*>(&data_folder_of), &found) == 0 || !found.dli_fname) return {};
  const std::filesystem::path file = found.dli_fname;
  if (file.filename().string().find(".so") == std::string::npos) return {};
  std::error_code unknown;
  return std::filesystem::canonical(file, unknown).parent_path();
}

}  // namespace

std::filesystem::path program_folder() {
  std::error_code unknown;
  return std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
}

std::filesystem::path data_folder() {
  const std::filesystem::path library = library_folder();
  return data_folder_of(library.empty() ? program_folder() : library);
}

std::filesystem::path data_folder_of(const std::filesystem::path& folder) {
  // PREFIX/libexec/edgevo, PREFIX/lib/TRIPLET/edgevo, PREFIX/lib/python3/dist-packages/edgevo.
  constexpr int kLevels = 4;
  std::error_code ignored;
  std::filesystem::path above = folder;
  for (int level = 0; level < kLevels && above.has_relative_path(); ++level) {
    above = above.parent_path();
    if (std::filesystem::is_directory(above / "share/edgevo", ignored)) return above / "share/edgevo";
  }
  return folder.parent_path() / "share/edgevo";
}

}  // namespace edgevo
