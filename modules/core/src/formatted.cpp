// SPDX-License-Identifier: BSD-3-Clause
#include "edgevo/core/formatted.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace edgevo {

std::string formatted(const char* format, ...) {
  std::va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  std::string text(size_t(std::max(0, std::vsnprintf(nullptr, 0, format, arguments))), ' ');
  va_end(arguments);
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  return text;
}

}  // namespace edgevo
