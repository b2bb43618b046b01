#include "edgevo/core/input_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "edgevo/core/error.h"

namespace edgevo {

std::string read_file(const std::string& path, const std::string& remedy) {
  const auto fail = [&](int error_number) {
    throw InputError(path, std::string("cannot be read: ") + std::strerror(error_number), remedy);
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) fail(errno);
  std::string bytes;
  char buffer[1 << 16];
  while (const size_t n = std::fread(buffer, 1, sizeof buffer, file.get())) bytes.append(buffer, n);
  if (std::ferror(file.get())) fail(errno);  // a folder opens, but does not read
  return bytes;
}

}  // namespace edgevo
