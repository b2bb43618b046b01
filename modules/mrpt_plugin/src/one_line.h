// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <exception>
#include <string>

namespace edgevo {

/// Message of an MRPT exception without its call stack.
std::string one_line(const std::exception& error);

}  // namespace edgevo
