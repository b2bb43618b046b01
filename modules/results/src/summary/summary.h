#pragma once
// summary.yaml: what was run, with what, how well and how fast.
#include <string>
#include <vector>

#include "edgevo/core/records.h"
#include "edgevo/report/map_report.h"
#include "edgevo/report/run_info.h"
#include "resource_use.h"

namespace edgevo {

struct SummaryInput {
  const Run& run;
  const RunInfo& info;
  ResourceUse use;               ///< of the run, images for the playback included
  ResourceUse use_with_outputs;  ///< the same with the writing of the outputs
  MapReport map;
  std::vector<std::string> not_written;
};

std::string summary_yaml(const SummaryInput& input);

}  // namespace edgevo
