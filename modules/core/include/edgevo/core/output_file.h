#pragma once
// A file being written, with every write and the close checked: a full disk is told, never swallowed.
//
// A std::ofstream that nobody asks afterwards loses data silently, since what fails is often the last flush.
// Here each failure is an InputError such as
//     out/frames.csv: cannot be written: No space left on device; free space or give another -o; what was
//     written so far is kept
// An existing file is overwritten. Numbers are formatted without regard to the locale and in the same way
// every time, so that two runs give the same bytes.
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace edgevo {

/// A file open for writing.
class OutputFile {
 public:
  /// Opens `path` for writing. Throws InputError.
  explicit OutputFile(std::string path);
  /// Closes; a failure here goes unheard, so call close() where the content matters (everywhere but while
  /// unwinding).
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Appends bytes. Throws InputError.
  void write(std::string_view bytes);
  /// Flushes and closes. Throws InputError. Nothing may be written afterwards.
  void close();

  const std::string& path() const { return path_; }  ///< as given

 private:
  [[noreturn]] void fail(int error_number) const;

  std::string path_;
  std::FILE* file_ = nullptr;
};

/// Writes one file in one go. Throws InputError.
void write_file(const std::string& path, std::string_view bytes);

/// Makes the folder and those above it, if need be. Throws InputError, for instance when a file of that name
/// is there.
void make_output_folder(const std::string& path);

/// Appends `value` with `decimals` digits after a '.', whatever the locale; no "-0.000".
void append_fixed(std::string* text, double value, int decimals);
std::string fixed(double value, int decimals);  ///< the same as a text

}  // namespace edgevo
