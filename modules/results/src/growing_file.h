#pragma once
// A file that grows while the program runs: what was appended is with the system at once, and stays when the
// program is killed.
#include <string>
#include <string_view>

namespace edgevo {

class GrowingFile {
 public:
  GrowingFile() = default;
  ~GrowingFile() { close(); }
  GrowingFile(const GrowingFile&) = delete;
  GrowingFile& operator=(const GrowingFile&) = delete;

  /// Begins an empty file, which nobody else may begin while it is open (see is_growing). False: it cannot
  /// be.
  [[nodiscard]] bool open(const std::string& path);
  /// False: there is no room, or it is not open.
  [[nodiscard]] bool append(std::string_view bytes);
  void close();
  bool is_open() const { return file_ >= 0; }

  /// Another program has the file open as a GrowingFile.
  static bool is_growing(const std::string& path);

 private:
  bool empty_it();

  int file_ = -1;
};

}  // namespace edgevo
