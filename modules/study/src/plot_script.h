// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

namespace edgevo {

/// The gnuplot script that draws the plots from the tables in its folder.
std::string plot_script();

}  // namespace edgevo
