// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Folder of the running program, from which files built or installed with it are found.
#include <filesystem>

namespace edgevo {

/// Folder of the program's executable, with links resolved; empty if unknown (no /proc).
std::filesystem::path program_folder();

/// Folder share/edgevo of the build or installation of the running program, which is in bin/ or
/// libexec/edgevo/; of a shared library (a module of Python, a plug-in) that of its own.
std::filesystem::path data_folder();

/// Folder share/edgevo for a program in `folder`: that of the nearest parent that has one; else the one that
/// the direct parent would have.
std::filesystem::path data_folder_of(const std::filesystem::path& folder);

}  // namespace edgevo
