#pragma once
// What a user must know before the results of a run are used: on the console, first on the report, in
// summary.yaml.
#include <string>
#include <vector>

#include "edgevo/core/records.h"

namespace edgevo {

/// One sentence each; empty where there is nothing to warn of.
std::vector<std::string> run_warnings(const Run& run);

}  // namespace edgevo
