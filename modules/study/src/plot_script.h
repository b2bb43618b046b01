#pragma once
#include <string>

namespace edgevo {

/// The gnuplot script that draws the plots from the tables beside it.
std::string plot_script();

}  // namespace edgevo
