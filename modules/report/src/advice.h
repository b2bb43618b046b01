// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Hints on what to do next, derived from the run: the list at the top of report.html.
#include <string>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/report/run_info.h"

namespace edgevo {

/// A hint, with a command to copy or an empty one. Both are plain text.
struct Advice {
  std::string text, command;
};

/// Hints for a run: problems first, then uses of the results. Commands are meant for a shell in the folder of
/// the report.
std::vector<Advice> advise(const Run& run, const RunInfo& info);

}  // namespace edgevo
