#pragma once
// The table of `edgevo compare`: a row a run, columns that assets/compare.js sorts by.
#include <string>
#include <vector>

#include "run_figures.h"

namespace edgevo {

/// In the order given.
std::string run_table_html(const std::vector<RunFigures>& runs);

}  // namespace edgevo
