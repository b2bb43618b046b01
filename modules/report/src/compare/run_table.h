// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The table of `edgevo compare`: one row a run; assets/compare.js sorts by the columns.
#include <string>
#include <vector>

#include "run_figures.h"

namespace edgevo {

/// The table as HTML, with the runs in the given order.
std::string run_table_html(const std::vector<RunFigures>& runs);

}  // namespace edgevo
