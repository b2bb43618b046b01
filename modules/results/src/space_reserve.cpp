// SPDX-License-Identifier: BSD-3-Clause
#include "space_reserve.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <utility>

#include "edgevo/core/error.h"

namespace edgevo {

SpaceReserve::SpaceReserve(const std::string& folder, size_t bytes) {
  std::string name = folder + "/.reserve_XXXXXX";
  file_ = mkostemp(name.data(), O_CLOEXEC);
  if (file_ < 0) return;  // the first file written there will give a better reason
  unlink(name.c_str());
  const int error = posix_fallocate(file_, 0, off_t(bytes));
  if (error != ENOSPC && error != EDQUOT) return;
  release();
  throw InputError(folder, "cannot be written: No space left on device", "free space or give another -o");
}

void SpaceReserve::release() {
  if (file_ >= 0) ::close(std::exchange(file_, -1));
}

}  // namespace edgevo
