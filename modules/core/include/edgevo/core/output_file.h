// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// An output file with every write and the close checked: a full disk is reported, never ignored.
//
// A std::ofstream whose state is not checked at the end loses data silently, since often the last flush
// fails. Here each failure is an InputError such as
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
  /// Closes and ignores a failure: call close() first wherever the content matters (everywhere except during
  /// stack unwinding).
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  /// Appends bytes. Throws InputError.
  void write(std::string_view bytes);
  /// Passes what was written so far to the system, so that it survives the death of the program. Throws
  /// InputError.
  void flush();
  /// Flushes and closes. Throws InputError. Nothing may be written afterwards.
  void close();

  /// Path as given to the constructor.
  const std::string& path() const { return path_; }

 private:
  [[noreturn]] void fail(int error_number) const;

  std::string path_;
  std::FILE* file_ = nullptr;
};

/// Writes a whole file. Throws InputError.
void write_file(const std::string& path, std::string_view bytes);

/// Creates the folder and its parents if necessary. Throws InputError, for instance if a file has that name.
void make_output_folder(const std::string& path);

/// Appends `value` with `decimals` digits after a '.', whatever the locale; no "-0.000".
void append_fixed(std::string* text, double value, int decimals);
/// `value` with `decimals` digits, as append_fixed() writes it.
std::string fixed(double value, int decimals);

}  // namespace edgevo
