#pragma once
#include <exception>
#include <string>

namespace edgevo {

/// What an exception of MRPT says, without the call stack below it.
std::string one_line(const std::exception& error);

}  // namespace edgevo
