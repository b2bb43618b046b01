// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A folder that no other test, run or user shares. Never write to a fixed name in the common
// temporary folder: ctest runs every test as a process of its own, several at a time, and files
// of another user there cannot be overwritten.
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>

namespace edgevo::test {

/// A new empty folder, removed by the destructor.
class TempFolder {
 public:
  TempFolder() {
    namespace fs = std::filesystem;
    // In memory where that is possible: the fuzz tests write thousands of files.
    const fs::path memory = "/dev/shm";
    const bool in_memory = !std::getenv("TMPDIR") && access(memory.c_str(), W_OK) == 0;
    std::string name = ((in_memory ? memory : fs::temp_directory_path()) / "edgevo_test_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category(), name);
    path_ = name;
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }
  /// Writes a file into the folder and returns its path.
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return *this / name;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace edgevo::test
