// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace edgevo {

/// Value of a parameter that is "auto" (gives 0) or a positive number. Throws InputError naming `key` for
/// anything else.
double auto_or_length(const std::string& key, const std::string& text);

}  // namespace edgevo
