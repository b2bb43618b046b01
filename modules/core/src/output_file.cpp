// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/output_file.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

std::string remedy(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
      return "free space or give another -o; what was written so far is kept";
    case EACCES:
    case EPERM:
    case EROFS:
      return "give another -o, a folder that you may write to";
    default:
      return "give another -o; what was written so far is kept";
  }
}

}  // namespace

OutputFile::OutputFile(std::string path) : path_(std::move(path)) {
  file_ = std::fopen(path_.c_str(), "wb");
  if (!file_) fail(errno);
}

OutputFile::~OutputFile() {
  if (file_) std::fclose(file_);
}

void OutputFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail(errno);
}

void OutputFile::flush() {
  if (std::fflush(file_) != 0) fail(errno);
}

void OutputFile::close() {
  // fclose() frees the stream even when its flush fails.
  if (std::fclose(std::exchange(file_, nullptr)) != 0) fail(errno);
}

void OutputFile::fail(int error_number) const {
  throw InputError(path_, std::string("cannot be written: ") + std::strerror(error_number),
                   remedy(error_number));
}

void write_file(const std::string& path, std::string_view bytes) {
  OutputFile out(path);
  out.write(bytes);
  out.close();
}

void make_output_folder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  std::error_code unknown;
  const bool is_folder = std::filesystem::is_directory(path, unknown);
  if (!error && is_folder) return;
  const bool is_file = std::filesystem::exists(path, unknown) && !is_folder;
  throw InputError(
      path, is_file ? "is a file, but a folder is needed here" : "cannot be created: " + error.message(),
      "give the path of a folder that can be created or written to");
}

void append_fixed(std::string* text, double value, int decimals) {
  if (std::abs(value) < 0.5 * std::pow(10.0, -decimals)) value = 0;  // also turns -0 into 0
  char buffer[512];  // the largest double has 309 digits before the point
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed, decimals);
  text->append(buffer, end.ptr);
}

std::string fixed(double value, int decimals) {
  std::string text;
  append_fixed(&text, value, decimals);
  return text;
}

}  // namespace edgevo
