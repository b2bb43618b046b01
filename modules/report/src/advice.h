#pragma once
// What a user can do next, from what a run shows: the list at the top of report.html.
#include <string>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/report/run_info.h"

namespace edgevo {

/// A sentence, and a command to copy where there is one. Both are plain text.
struct Advice {
  std::string text, command;
};

/// Troubles first, then where the results are seen and used. Commands are written for a shell in the folder
/// of the report.
std::vector<Advice> advise(const Run& run, const RunInfo& info);

}  // namespace edgevo
