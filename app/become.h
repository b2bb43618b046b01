// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace edgevo::app {

/// Replaces this process with `program`, called with these words (the first is the program's name). Throws
/// InputError with `remedy` if it cannot be run.
[[noreturn]] void become(const std::filesystem::path& program, const std::vector<std::string>& words,
                         const std::string& remedy);

}  // namespace edgevo::app
