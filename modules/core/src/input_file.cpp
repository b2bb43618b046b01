// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/input_file.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "edgevo/core/error.h"

namespace edgevo {
namespace {

// The largest file that is read whole, edges.ply, has 60 bytes a point: room for thirty million points.
constexpr off_t kLargest = off_t(2) << 30;

// By the byte order mark, or since the first two characters have a byte of zeros each.
bool is_utf16(const std::string& text) {
  if (text.rfind("\xFF\xFE", 0) == 0 || text.rfind("\xFE\xFF", 0) == 0) return true;
  if (text.size() < 4) return false;
  const auto zero = [&](size_t i) { return text[i] == 0; };
  return (!zero(0) && zero(1) && !zero(2) && zero(3)) || (zero(0) && !zero(1) && zero(2) && !zero(3));
}

}  // namespace

void check_regular_file(const std::string& path, const std::string& remedy) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0)
    throw InputError(path, std::string("cannot be read: ") + std::strerror(errno), remedy);
  if (S_ISDIR(status.st_mode))
    throw InputError(path, std::string("cannot be read: ") + std::strerror(EISDIR), remedy);
  if (!S_ISREG(status.st_mode))  // a device may be endless, a pipe may block
    throw InputError(path, "cannot be read: it is a device or a pipe, not a file", remedy);
  if (status.st_size > kLargest)
    throw InputError(path, "cannot be read: it is larger than 2 GB, which no file of its kind is", remedy);
}

std::string read_file(const std::string& path, const std::string& remedy) {
  check_regular_file(path, remedy);
  const auto fail = [&](int error_number) {
    throw InputError(path, std::string("cannot be read: ") + std::strerror(error_number), remedy);
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail(errno);
  std::string bytes;
  char buffer[1 << 16];
  while (const size_t n = std::fread(buffer, 1, sizeof buffer, file.get())) bytes.append(buffer, n);
  if (std::ferror(file.get())) fail(errno);
  return bytes;
}

std::string read_text(const std::string& path, const std::string& remedy) {
  std::string text = read_file(path, remedy);
  if (is_utf16(text)) throw InputError(path, "the text is UTF-16, which is not read", "save it as UTF-8");
  if (text.rfind("\xEF\xBB\xBF", 0) == 0) text.erase(0, 3);
  return text;
}

}  // namespace edgevo
