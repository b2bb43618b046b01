#pragma once
#include <string>

namespace edgevo {

/// A parameter that is "auto" (0) or a positive number. Throws InputError naming `key` for anything else.
double auto_or_length(const std::string& key, const std::string& text);

}  // namespace edgevo
