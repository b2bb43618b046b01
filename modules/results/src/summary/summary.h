// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// summary.yaml: input, settings, quality and speed of a run.
#include <string>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/report/map_report.h"
#include "edgevo/report/run_info.h"
#include "resource_use.h"

namespace edgevo {

/// Everything that summary.yaml is written from.
struct SummaryInput {
  /// The run.
  const Run& run;
  /// Description of the run.
  const RunInfo& info;
  /// Resources used by the run, including the images for the playback.
  ResourceUse use;
  /// Resources used by the run and the writing of its outputs.
  ResourceUse use_with_outputs;
  /// Statistics of the map files.
  MapReport map;
  /// Names of the files that could not be written.
  std::vector<std::string> not_written;
};

/// Text of summary.yaml.
std::string summary_yaml(const SummaryInput& input);

}  // namespace edgevo
