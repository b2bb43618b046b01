#pragma once
#include <string>

namespace edgevo::app {

/// "0.1.0 COMMIT BUILD_TYPE": what a result was made with, in a word or three.
std::string version();
/// The same and the versions of the libraries that the program was built with, a few lines.
std::string version_text();

}  // namespace edgevo::app
