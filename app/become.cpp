// SPDX-License-Identifier: BSD-3-Clause
#include "become.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "edgevo/core/error.h"

namespace edgevo::app {

void become(const std::filesystem::path& program, const std::vector<std::string>& words,
            const std::string& remedy) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  execv(program.c_str(), argv.data());
  throw InputError(program.string(), "cannot be run: " + std::string(std::strerror(errno)), remedy);
}

}  // namespace edgevo::app
