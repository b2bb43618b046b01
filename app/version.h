// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace edgevo::app {

/// Version, commit and build type, as in "0.1.0 COMMIT BUILD_TYPE".
std::string version();
/// Version, commit, build type, compiler and the versions of the libraries, on several lines.
std::string version_text();

}  // namespace edgevo::app
