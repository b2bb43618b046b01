#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace edgevo::app {

/// Replaces this process by `program`, which is called with these words (the first is its name). Throws
/// InputError with `remedy` where it cannot be run.
[[noreturn]] void become(const std::filesystem::path& program, const std::vector<std::string>& words,
                         const std::string& remedy);

}  // namespace edgevo::app
